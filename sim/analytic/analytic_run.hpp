// SPDX-License-Identifier: Apache-2.0
// degs run --fidelity analytic: the time of a frame without a simulation. docs/analytic.md explains
// the method.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "modules/kit/analytic/analytic_frame.hpp"
#include "sim/analytic/what_if_run.hpp"
#include "sim/cache/cached_view.hpp"
#include "sim/design/run_config.hpp"
#include "sim/report/measures.hpp"
#include "sim/simulation/what_if.hpp"
#include "sim/view/frame_facts.hpp"

namespace degs::sim {

/// Raised whenever a key of analytic.json changes its meaning, name or unit.
constexpr int kAnalyticVersion = 1;

struct AnalyticRun {
    SceneFacts scene;
    Camera camera;
    RunConfig config;
    WorkloadFacts workload;
    AnalyticFrame frame;
    cost::RunEnergy energy;
    double memory_gb_per_s = 0; ///< peak
    std::vector<WhatIf> what_if;
    std::vector<std::string> warnings;
    double load_s = 0, workload_s = 0, estimate_s = 0; ///< host
};

/// The model of the design. Throws InputError if its accelerator has none.
std::unique_ptr<AnalyticModel> analytic_model_of(const RunConfig& config);
/// A frame that was made for the design. The caller fills in the host times of earlier steps.
/// Throws InputError likewise.
AnalyticRun run_analytic(const RunConfig& config, const SceneFacts& scene,
                         const FrameWorkload& frame);
/// The frame of the view on the design, and what changes of the design are worth. Throws InputError
/// likewise.
AnalyticRun run_analytic(const RunConfig& config, CachedView& view,
                         const std::vector<ChangedDesign>& changed = {});

/// Whether an estimate, or a comparison of estimates, has the measure.
bool is_estimated(Measure measure);
/// Measures of an estimate by itself: those of is_estimated() without the ratios.
Measures measures_of(const AnalyticRun& run);

/// analytic.json
nlohmann::ordered_json analytic_json(const AnalyticRun& run);
/// For terminals: a table of the units, the estimate and its bounds.
std::string analytic_text(const AnalyticRun& run);

} // namespace degs::sim
