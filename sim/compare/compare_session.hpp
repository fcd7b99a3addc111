// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/compare/comparison_output.hpp"
#include "sim/results/comparison.hpp"
#include "sim/runs/run_progress.hpp"
#include "sim/runs/view_runs.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/study/compare_request.hpp"

namespace degs::sim {

/// Names of the files that a comparison writes into its folder.
std::vector<std::string> comparison_files();

/// Runs all configurations on all views. Results are written to the folder after every run.
class CompareSession {
public:
    /// Told that all runs of the first `views` views of the comparison have ended.
    using ViewsEnded = std::function<void(const Comparison& comparison, std::size_t views)>;

    CompareSession(const CompareRequest& request, const OutputFolder& out,
                   ViewsEnded views_ended = {}, AreaScale scale = AreaScale::Own);
    CompareSession(const CompareSession&) = delete;
    CompareSession& operator=(const CompareSession&) = delete;

    /// Returns when all is done or Ctrl-C has come. A mistake in one scene, camera or configuration
    /// costs the views or runs concerned; the comparison and failure() report it. Throws
    /// FailureError as soon as results cannot be written, because the others would be simulated in
    /// vain.
    Comparison run();
    /// The failure that kept the comparison from being complete.
    std::optional<Failure> failure() const;
    /// The warnings of the runs, each sentence once for each configuration.
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    /// One configuration on one view: what its runs have found so far.
    struct Found {
        std::optional<RunSummary> frame, path;
        std::string report; ///< of the frame
    };

    void end(const ViewRun& run, ChildOutcome&& outcome);
    void take(const ViewRun& started, ChildOutcome&& outcome);
    void tell_views();
    void fail(const std::string& config, const std::string& view, const Failure& failure);
    Failure interruption() const;
    Comparison comparison() const;
    void write() const;

    const CompareRequest& request_;
    const OutputFolder& out_;
    ViewsEnded views_ended_;
    AreaScale scale_;                ///< of ratios.svg
    std::vector<std::size_t> ended_; ///< runs of every view that have ended
    std::size_t told_ = 0;           ///< views, in their order, all runs of which have ended
    std::map<std::pair<std::size_t, std::size_t>, Found> found_; ///< by view and configuration
    std::vector<FailedRun> failed_;
    std::vector<std::string> warnings_;
    std::optional<Failure> unwritten_; ///< results that could not be written
    std::vector<Failure> failures_;    ///< of the failed runs, with their codes
    RunProgress progress_;
    bool interrupted_ = false;
    ViewRuns runs_; ///< the last, because it calls back
};

} // namespace degs::sim
