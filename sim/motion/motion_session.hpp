// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/motion/motion.hpp"
#include "sim/motion/motion_output.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/report/measures.hpp"
#include "sim/runs/run_progress.hpp"
#include "sim/runs/view_runs.hpp"
#include "sim/shell/output_folder.hpp"

namespace degs::sim {

/// Names of the files that a session writes into its folder.
std::vector<std::string> motion_files();

/// Renders every frame of a path by itself on all designs. Results are written every second.
class MotionSession {
public:
    /// `request` has one scene and the views of the path; it and `out` outlive this object.
    MotionSession(const CompareRequest& request, const OutputFolder& out, MotionWords words,
                  Motion motion);
    MotionSession(const MotionSession&) = delete;
    MotionSession& operator=(const MotionSession&) = delete;

    /// Returns when all is done or Ctrl-C has come. A run that fails costs its frame and design,
    /// which failure() reports. Throws FailureError as soon as results cannot be written, and
    /// InputError if the last ones cannot.
    const Motion& run();
    std::optional<Failure> failure() const;
    /// The warnings of the runs, each sentence once for each design.
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    void end(const ViewRun& run, ChildOutcome&& outcome);
    void take(const ViewRun& run, const ChildOutcome& outcome);
    void put(const ViewRun& run, const Measures& measures);
    void write();
    Failure interruption() const;

    const CompareRequest& request_;
    const OutputFolder& out_;
    MotionWords words_;
    Motion motion_;
    /// The measures that the first of two runs has found, by configuration and camera.
    std::map<std::pair<std::size_t, int>, std::pair<bool, Measures>> halves_;
    std::vector<std::string> warnings_;
    std::vector<Failure> failures_;
    std::optional<Failure> unwritten_;
    bool interrupted_ = false, found_ = false;
    Stopwatch written_;
    RunProgress progress_{"frame"};
    ViewRuns runs_; ///< the last, because it calls back
};

} // namespace degs::sim
