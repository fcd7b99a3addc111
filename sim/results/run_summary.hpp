// SPDX-License-Identifier: Apache-2.0
// The results of a run that a comparison needs, and the message in which they come back from the
// process that ran it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/analytic/analytic_run.hpp"
#include "sim/report/measures.hpp"
#include "sim/simulation/frame_changes.hpp"

namespace degs::sim {

struct ComparedView {
    std::string scene, source, camera_name;
    int camera = 0; ///< position in the scene's list
    int width = 0, height = 0;
    std::size_t gaussians = 0, visible = 0;
    std::optional<std::size_t> fragments;  ///< of the reference
    std::optional<FrameChanges> changes{}; ///< if there are several frames
    int views = 1;                         ///< of a frame
    bool dynamic = false; ///< frames of a scene that changes; not part of the message
};

using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// What one configuration did on one view.
struct RunNumbers {
    std::string fidelity; ///< exact, strict, sampled, or analytic: an estimate without simulation
    Measures measures;
    std::optional<double> first_task_ms; ///< from the start of the run
    std::optional<double> last_task_ms;  ///< end, from the start of the run
    std::optional<double> sampled_share; ///< of the tiles; empty: all of them
    std::optional<double> cycles_low,
        cycles_high;        ///< 95 % interval of a sample, 90 % of an estimate
    std::string limited_by; ///< the busiest stage, or memory
    NamedNumbers stages;    ///< with the share of the run they worked
    NamedNumbers parts;     ///< single buffers and blocks by their names, see part_statistics()
};

/// Between which the latency of `after` over that of `before` lies: at the worst ends of the
/// intervals if one of them is a sample; that of a change between two estimates. Empty between
/// exact runs.
std::optional<std::pair<double, double>> latency_ratio_interval(const RunNumbers& before,
                                                                const RunNumbers& after);

/// One configuration on one view.
struct RunSummary : RunNumbers {
    std::string accelerator;
    int pes = 0, tile_size = 0;
    ComparedView view;
    std::vector<std::string> notes;    ///< sentences about the scene, the same in all its runs
    std::vector<std::string> warnings; ///< other sentences; see warnings.hpp
    std::string report;                ///< report.json of the run; empty if nobody wants it
};

/// The names of RunNumbers::parts, with * for that of a buffer or block, units and meanings.
std::vector<Statistic> part_statistics();

/// Without the report. `camera` is the view's position in the scene's list.
RunSummary summary_of(const RunResult& result, int camera);

/// An estimate as a summary without the report; its stages are the units of the model.
RunSummary summary_of(const AnalyticRun& run, int camera);

/// Raised whenever a field of the message changes.
constexpr int kSummaryVersion = 14;

/// The summary as bytes for another process of this program.
std::string message_of(const RunSummary& summary);
/// Throws std::runtime_error, which names the field, if the message is of another version, if it is
/// cut off, and if a field is missing, unknown or not of its type.
RunSummary summary_from(const std::string& message);

} // namespace degs::sim
