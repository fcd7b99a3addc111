// SPDX-License-Identifier: Apache-2.0
// One of several processes that make the same search in one folder.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "sim/sweep/array_task.hpp"
#include "sim/sweep/point_store.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// The k-th of n processes, on this machine or others. All of them decide the same, because they
/// know the same points: of the points that a step adds, each runs its part and waits until the
/// others have run theirs. A point that has failed stays failed, so that nobody decides by a
/// failure that another one is trying to mend.
class SearchPart {
public:
    /// The only one.
    SearchPart() = default;
    /// `patience`: seconds without a point of the others before this part gives up.
    SearchPart(ArrayTask task, double patience) : task_(task), patience_(patience) {}

    bool is_alone() const { return task_.n == 1; }
    /// Whether this process writes tables, pages and reports: one of them does.
    bool writes() const { return task_.k == 1; }
    /// "part 2 of 3".
    std::string name() const;

    /// The points of this part, in ascending order, with those that are finished. Of a step that
    /// runs in `folder`, as steps before it may have done.
    std::vector<std::size_t> own_points(const StudyPlan& step, const PointStore& store,
                                        const std::string& folder);
    /// Until all points of the step that own_points() was asked for have been finished or have
    /// failed. Throws FailureError, which names the parts that are missing, when patience ends.
    void wait_for_others(const PointStore& store) const;

private:
    /// A point that the step has added.
    struct Added {
        std::size_t point = 0;
        std::size_t part = 1; ///< which runs it
    };
    std::string waiting_words(const std::vector<Added>& open) const;

    ArrayTask task_;
    double patience_ = 0;
    std::set<std::string> seen_; ///< folders and keys of the points of all steps
    std::vector<Added> added_;   ///< by the last one
};

} // namespace degs::sim
