// SPDX-License-Identifier: Apache-2.0
// One run: frames -> accelerator -> result.
#pragma once

#include <optional>

#include "sim/simulation/run_result.hpp"
#include "splat/frame/frame_source.hpp"

namespace degs::sim {

struct RunRequest {
    RunConfig config;
    Fidelity fidelity = Fidelity::Exact;
    BuildOptions build;
    bool reference = true; ///< render the double-precision image and compare
    int views = 1;         ///< of a frame; they follow each other
    Recording recording;
    std::optional<SamplingRequest> sampling; ///< simulate a sample of the tiles, if it will do
};

/// Runs the accelerator on frames that are made for it (at least one, of as many views as the
/// request says), each when it is needed. The caller completes the result (completed_run.hpp) and
/// fills in the host times of earlier steps. Throws std::logic_error if the model violates an
/// invariant. May be called once per process. If no sample will do, the run is exact, with a
/// warning. InputError for a sample of several frames.
RunResult run_frames(const RunRequest& request, FrameSource frames);

} // namespace degs::sim
