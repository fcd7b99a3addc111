// SPDX-License-Identifier: Apache-2.0
// The folder of a study: a file for each finished point, written whole or not at all.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/process/failure.hpp"
#include "sim/results/run_summary.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/sweep/folder_lock.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// What the runs of a point have found, with their reports.
struct StoredPoint {
    RunSummary frame;
    std::optional<RunSummary> path; ///< if the study has a camera path
};

/// Whether a folder is of one plan, or of the steps of a search, whose processes need not be at the
/// same one.
enum class Steps { One, Several };

/// Points are found by their keys, so studies may share a folder, and a point that one of them has
/// finished is finished for all. Several processes may use the folder at once for one study, on
/// this machine or others: a point has the same content whoever ran it. Results in the folder are
/// always those of the study that it names.
class PointStore {
public:
    /// Creates the folder or goes on with it; results of another study are removed. Throws
    /// InputError if it holds results of another kind, cannot be written, or is in use for another
    /// study.
    PointStore(const std::string& folder, const StudyPlan& plan, Steps steps = Steps::One);

    const OutputFolder& folder() const { return folder_; }
    /// Throws InputError if the folder is of another study by now, which only happens without
    /// locks.
    void require_own() const;
    /// What is known of a point; empty if it has not been finished, or if its file is damaged.
    /// Throws InputError for what is no regular file, which may have no end.
    std::optional<StoredPoint> read(std::size_t point) const;
    /// Whether the point has a file that is damaged.
    bool is_damaged(std::size_t point) const;
    /// Why a point failed when it was last tried.
    std::optional<Failure> failure(std::size_t point) const;

    /// Writes the point, which is finished with that. Throws InputError if that is not possible.
    void keep(std::size_t point, const StoredPoint& found) const;
    void keep_failure(std::size_t point, const Failure& failure) const;
    /// Puts the reports of the point beside the results, numbered as the plan does it; without a
    /// point, removes those of another study. Files that have the content already stay as they are.
    void put_reports(std::size_t point, const std::optional<StoredPoint>& found) const;
    /// The frame's report relative to the folder.
    static std::string report_of(std::size_t point);
    /// Removes reports of points beyond those of the plan.
    void drop_other_reports() const;
    /// Does that, and removes what killed processes left half written. Nobody else may be writing.
    void sweep_up() const;

private:
    std::string heading(std::size_t point) const;

    OutputFolder folder_;
    FolderLock lock_;
    std::string state_; ///< the text that names the study
    OutputFolder points_, reports_;
    std::vector<std::string> keys_; ///< by point
};

} // namespace degs::sim
