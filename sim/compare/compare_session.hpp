// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/child_process.hpp"
#include "sim/compare/compare_request.hpp"
#include "sim/compare/comparison.hpp"
#include "sim/output_folder.hpp"
#include "sim/simulation.hpp"
#include "sim/text/progress.hpp"

namespace degs::sim {

/// Names of what a comparison writes into its folder.
std::vector<std::string> comparison_files();

/// Runs all configurations on all views, each run in a process of its own. Frames, reference images
/// and scenes are made once and shared by all runs that want them. What has been found so far is on
/// disk after every group of runs.
class CompareSession {
public:
    CompareSession(const CompareRequest& request, const OutputFolder& out)
        : request_(request), out_(out) {}

    /// Returns when all is done or Ctrl-C has come. A mistake in one scene, camera or configuration
    /// costs the views or runs concerned; the comparison and failure() tell of it.
    Comparison run();
    /// What kept the comparison from being complete.
    std::optional<Failure> failure() const;

private:
    /// One view while it is compared.
    struct Shared;
    using Configs = std::vector<std::size_t>;

    void run_scene(const std::string& spec);
    void run_view(const Scene& scene, int camera, const ImageSize& size, double load_s);
    void run_group(Shared& shared, const Configs& configs);
    std::vector<ChildJob> jobs_of(const Shared& shared, const Configs& configs) const;
    void take(const Shared& shared, std::size_t config, bool path, ChildOutcome&& outcome);
    void fail(const std::string& config, const std::string& view, const Failure& failure);
    Comparison comparison() const;
    void write() const;

    const CompareRequest& request_;
    const OutputFolder& out_;
    std::size_t views_ = 0;                                           ///< begun
    std::map<std::pair<std::size_t, std::size_t>, ComparedRun> runs_; ///< by view and configuration
    std::vector<FailedRun> failed_;
    std::vector<Failure> failures_; ///< the same with their codes
    std::size_t ended_ = 0;
    bool interrupted_ = false;
};

} // namespace degs::sim
