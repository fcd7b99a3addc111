// SPDX-License-Identifier: Apache-2.0
// Several accelerators on the same views, made comparable. docs/compare.md is the manual.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace degs::sim {

/// What is compared. A ratio is above 1 for what is better than the first configuration.
enum class Measure {
    Cycles,
    LatencyMs,
    Fps,
    ThroughputFps, ///< of the camera path
    Useful,        ///< this and the next six: shares of the slots, in the order of reports
    Boundary,
    Terminated,
    Conflict,
    Starved,
    Blocked,
    Drain,
    Utilization,
    FrameUtilization,
    DramRead,    ///< bytes
    DramWritten, ///< bytes
    DramUtilization,
    AreaMm2,
    LatencyRatio,           ///< latency of the first / latency
    ThroughputRatio,        ///< throughput / throughput of the first
    LatencyRatioPerArea,    ///< the same with latency x area
    ThroughputRatioPerArea, ///< the same with throughput / area
    PsnrDb,
    Ssim,
    MaxAbsError,
    SimS, ///< host seconds of the run of one frame
    Count
};

/// A number for each measure; one that does not exist is empty, never 0.
class Measures {
public:
    std::optional<double>& operator[](Measure m) { return values_[static_cast<std::size_t>(m)]; }
    const std::optional<double>& operator[](Measure m) const {
        return values_[static_cast<std::size_t>(m)];
    }

private:
    std::array<std::optional<double>, static_cast<std::size_t>(Measure::Count)> values_;
};

/// Where a measure stands in compare.json, as a JSON pointer below its run, and in compare.csv,
/// with dots: "/slots/useful" is the column "slots.useful".
const char* place_of(Measure measure);

/// One configuration on one view, as `degs run` reports it.
struct ComparedRun {
    std::string config;           ///< what the user calls it
    int camera = 0;               ///< position in the scene's list
    nlohmann::ordered_json frame; ///< report of one frame alone
    nlohmann::ordered_json path;  ///< report of a camera path; null if there is none
};

struct FailedRun {
    std::string config;
    std::string view;
    std::string sentence;
};

struct ComparedView {
    std::string scene, source, camera_name;
    int camera = 0, width = 0, height = 0;
    std::size_t gaussians = 0, visible = 0;
    std::optional<std::size_t> fragments; ///< of the reference
};

struct ComparedConfig {
    std::string name;        ///< what the user calls it
    std::string accelerator; ///< empty like all that follows if no run of it has succeeded
    std::optional<int> pes, tile_size;
    std::optional<double> area_mm2;
};

struct ComparisonRow {
    std::size_t view = 0, config = 0; ///< into Comparison
    Measures measures;
};

struct Comparison {
    std::vector<ComparedConfig> configs; ///< the first is what the others are compared with
    std::vector<ComparedView> views;     ///< in the order of their first run
    std::vector<ComparisonRow> rows;     ///< in the order of the runs
    std::vector<FailedRun> failed;
    std::vector<ComparisonRow> means; ///< per configuration, if there are several views
    int frames = 1;                   ///< of the camera path; 1: there is none
    double path_step_degrees = 0;
    bool array_only = false;
};

/// `configs` in the order in which they are shown; the runs of each view follow one another. A
/// ratio is empty where the first configuration has no number, a geometric mean where the
/// configuration lacks a view. Throws std::logic_error for a run of none of the configurations.
Comparison compare(const std::vector<std::string>& configs, const std::vector<ComparedRun>& runs);

/// "flowers · camera 2 · 1920×1080"
std::string view_words(const ComparedView& view);
/// The configuration's name without its number of PEs: "degs-64-tuned" is of the family
/// "degs-tuned", whose members lie on one line.
std::string family_of(const ComparedConfig& config);

} // namespace degs::sim
