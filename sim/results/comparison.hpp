// SPDX-License-Identifier: Apache-2.0
// Several accelerators on the same views, made comparable. docs/compare.md is the manual.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/results/run_summary.hpp"

namespace degs::sim {

/// The results of one configuration on one view.
struct ComparedRun {
    std::string config;             ///< what the user calls it
    RunSummary frame;               ///< one frame alone
    std::optional<RunSummary> path; ///< the camera path, if there is one
    std::string report = {};        ///< file of the frame's report, relative to the results
};

struct FailedRun {
    std::string config;
    std::string view;
    std::string sentence;
};

struct ComparedConfig {
    std::string name;        ///< what the user calls it
    std::string accelerator; ///< empty like all that follows if no run of it has succeeded
    std::optional<int> pes, tile_size;
    std::optional<double> area_mm2;
};

/// The numbers of the frame, with what its comparison adds.
struct ComparisonRow : RunNumbers {
    std::size_t view = 0, config = 0; ///< into Comparison
    std::string report;               ///< as in ComparedRun
};

struct Comparison {
    std::vector<ComparedConfig> configs;
    std::size_t baseline = 0;        ///< the configuration with which the others are compared
    std::vector<ComparedView> views; ///< in the order of their first run
    std::vector<ComparisonRow> rows; ///< in the order of the runs
    std::vector<FailedRun> failed;
    std::vector<ComparisonRow> means; ///< per configuration, if there are several views
    int frames = 1;                   ///< of a camera path or of a scene that changes
    double path_step_degrees = 0;     ///< of camera paths
    bool array_only = false;

    /// Whether the numbers are estimates of the analytic model.
    bool is_estimated() const;
    /// Whether the camera moves in one of the views.
    bool has_camera_path() const;
    /// Whether one of the scenes changes from frame to frame, before a camera that stands still.
    bool has_dynamic_scene() const;
};

/// `configs` in the order in which they are shown; the runs of each view follow one another. A
/// ratio is empty where the baseline has no number, a geometric mean where the configuration lacks
/// a view. Throws std::logic_error for a run of none of the configurations.
Comparison compare(const std::vector<std::string>& configs, const std::vector<ComparedRun>& runs,
                   std::size_t baseline = 0);

/// "flowers · camera 2 · 1920×1080"
std::string view_words(const ComparedView& view);
/// The configuration's name without its number of PEs: "degs-64-tuned" is of the family
/// "degs-tuned", whose members lie on one line.
std::string family_of(const ComparedConfig& config);

} // namespace degs::sim
