// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/compare/compare_request.hpp"
#include "sim/compare/comparison.hpp"
#include "sim/compare/run_progress.hpp"
#include "sim/output_folder.hpp"
#include "sim/process/child_process.hpp"
#include "sim/simulation.hpp"

namespace degs::sim {

struct SharedView;

/// Names of the files that a comparison writes into its folder.
std::vector<std::string> comparison_files();

/// Runs all configurations on all views, each run in a process of its own, as many at a time
/// as the request allows; what this process makes for them counts as one. Frames, reference
/// images and scenes are made once and shared by all runs that want them. Results are written
/// to the folder after every run.
class CompareSession {
public:
    CompareSession(const CompareRequest& request, const OutputFolder& out);
    ~CompareSession();
    CompareSession(const CompareSession&) = delete;
    CompareSession& operator=(const CompareSession&) = delete;

    /// Returns when all is done or Ctrl-C has come. A mistake in one scene, camera or configuration
    /// costs the views or runs concerned; the comparison and failure() report it.
    Comparison run();
    /// The failure that kept the comparison from being complete.
    std::optional<Failure> failure() const;
    /// The warnings of the runs, each sentence once for each configuration.
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    struct Started;
    /// One configuration on one view: what its runs have found so far.
    struct Found {
        std::optional<RunSummary> frame, path;
    };
    using Configs = std::vector<std::size_t>;

    std::size_t runs_per_view() const;
    std::size_t runs_per_camera() const;

    Scene load(const std::string& spec, double& seconds) const;
    void run_scene(const std::string& spec);
    void run_view(const Scene& scene, int camera, const ImageSize& size, double load_s);
    void run_group(SharedView& shared, const Configs& configs);
    void start(const SharedView& shared, std::size_t config, bool path);
    void end(std::size_t number, ChildOutcome&& outcome);
    void show(const std::vector<std::size_t>& running);
    void take(const Started& started, ChildOutcome&& outcome);
    void fail(const std::string& config, const std::string& view, const Failure& failure);
    Failure interruption() const;
    Comparison comparison() const;
    void write() const;

    const CompareRequest& request_;
    const OutputFolder& out_;
    std::size_t views_ = 0;                                      ///< begun
    std::map<std::pair<std::size_t, std::size_t>, Found> found_; ///< by view and configuration
    std::vector<FailedRun> failed_;
    std::vector<std::string> warnings_;
    std::vector<Failure> failures_; ///< the same with their codes
    std::vector<Started> started_;  ///< by number of the run
    RunProgress progress_;
    bool interrupted_ = false;
    ChildPool pool_; ///< the last, because it calls back
};

} // namespace degs::sim
