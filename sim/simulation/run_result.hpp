// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/accelerator/accelerator_run.hpp"
#include "sim/design/run_config.hpp"
#include "sim/sampling/sampled_run.hpp"
#include "sim/simulation/foveated_image.hpp"
#include "sim/simulation/frame_changes.hpp"
#include "sim/simulation/what_if.hpp"
#include "sim/view/frame_facts.hpp"
#include "splat/images/image_metrics.hpp"

namespace degs::sim {

/// Seconds and bytes of the machine that simulates; the only part of a result that may differ
/// between two runs.
struct HostFacts {
    std::string fidelity;
    double load_s = 0, workload_s = 0, elaborate_s = 0, start_s = 0, sim_s = 0, functional_s = 0,
           run_s = 0, wall_s = 0;
    std::optional<double> render_s;
    std::uint64_t activations = 0; ///< see Timebase
    std::uint64_t peak_rss_bytes = 0;
};

/// One of several views of the first frame.
struct ViewFacts {
    Camera camera;
    WorkloadFacts workload;
    std::optional<ImageError> error; ///< against its reference
};

/// A key that moves a loss, and the first change of it that the design allows.
struct LossStep {
    std::string words;  ///< "raise KEY", "lower KEY and KEY" or "KEY=VALUE"
    std::string change; ///< "KEY=VALUE", or several of these separated by commas
};

struct RunResult {
    SceneFacts scene;
    Camera camera; ///< of the first view of the first frame
    RunConfig config;
    WorkloadFacts workload; ///< of that view
    AcceleratorResult accelerator;
    std::vector<LossStep> movable_keys;      ///< see LossKeys::movable; asked before the simulation
    std::vector<std::string> warnings;       ///< sentences; see warnings.hpp
    std::optional<ImageError> error;         ///< of that view against the reference
    std::vector<ViewFacts> views;            ///< of the first frame, if it has several
    std::optional<FoveationFacts> foveation; ///< then `camera` and `error` are of its first image
    std::optional<FrameChanges> changes;     ///< of a run of several frames
    std::optional<SamplingFacts> sampling;   ///< if the numbers are estimates from a sample
    std::vector<WhatIf> what_if;             ///< changes that were asked for (--what-if)
    std::vector<WhatIf> gains;               ///< changes that the largest losses name, if estimated
    HostFacts host;
};

/// Images of the first frame, and one of them: a view's, or composed from the levels of one.
std::size_t images_of(const RunResult& result);
const Image& image_of(const RunResult& result, std::size_t image);
const std::optional<ImageError>& error_of(const RunResult& result, std::size_t image);

/// Pixels of the first frame that its views draw, overlaps included.
std::uint64_t drawn_pixels(const RunResult& result);

} // namespace degs::sim
