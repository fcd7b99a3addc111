// SPDX-License-Identifier: Apache-2.0
// Runs points of a study.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "sim/runs/run_progress.hpp"
#include "sim/runs/view_runs.hpp"
#include "sim/sweep/point_store.hpp"

namespace degs::sim {

/// Points from `begin` up to, but without, `end`.
struct PointRange {
    std::size_t begin = 0, end = 0;
};

/// The k-th of n parts of about the same size, k from 1. Neighbouring points share frames, so a
/// part is a stretch.
PointRange shard_of(std::size_t points, std::size_t k, std::size_t n);

/// The points of a stretch in ascending order.
std::vector<std::size_t> points_of(PointRange range);

/// Runs those of some points of a plan that are not finished, each in a process of its own, and
/// keeps every one as soon as it is finished.
class SweepSession {
public:
    /// `finished` is called after each point.
    SweepSession(const StudyPlan& plan, const PointStore& store,
                 const std::vector<std::size_t>& points, std::function<void()> finished = {});

    /// False after Ctrl-C. A point that fails costs the others nothing. Throws FailureError as soon
    /// as a point cannot be kept, because the others would be simulated in vain.
    bool run();
    /// The worst failure, or the interruption.
    std::optional<Failure> failure() const;

private:
    /// Scene, camera, size and variant.
    using Place = std::tuple<std::size_t, int, std::size_t, std::size_t>;
    struct Pending {
        std::size_t point = 0;
        StoredPoint found;
        bool frame_found = false;
    };

    ViewRunsHooks hooks();
    static Place place_of(const ViewRun& run);
    void end(const ViewRun& run, ChildOutcome&& outcome);
    /// True when the point is finished.
    bool take(const ViewRun& run, ChildOutcome&& outcome);
    /// `why` is a sentence about a file that could not be written.
    void stop(const ViewRun& run, const std::string& why);
    void fail(const Place& place, const Failure& failure);
    void fail_where(const Failure& failure, const std::function<bool(const Place&)>& concerned);
    std::map<std::size_t, std::vector<int>> cameras_by_scene() const;
    Failure interruption() const;

    const StudyPlan& plan_;
    const PointStore& store_;
    std::function<void()> finished_;
    std::map<Place, Pending> pending_;
    std::map<std::size_t, Failure> failures_; ///< by point
    RunProgress progress_{"point"};
    bool interrupted_ = false;
    std::optional<Failure> unwritten_;
    ViewRuns runs_; ///< the last, because it calls back
};

} // namespace degs::sim
