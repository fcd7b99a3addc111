// SPDX-License-Identifier: Apache-2.0
// What must hold of every run, whatever the design: laws beyond those that a run checks itself.
#pragma once

#include <string>
#include <vector>

#include "modules/kit/accelerator/accelerator_result.hpp"
#include "modules/kit/accelerator/render_engine.hpp"
#include "splat/frame/frame_workload.hpp"

namespace degs::trials {

/// One finished run and what it was asked for.
struct Finished {
    const AcceleratorConfig& config;
    const std::vector<const FrameWorkload*>& frames;
    const AcceleratorResult& result;
};

/// A sentence for every bound on times, buffers and traffic that the run does not keep.
std::vector<std::string> broken_bounds(const Finished& run);

/// A sentence for every image that is not, bit by bit, what the same arithmetic gives without an
/// accelerator around it, and, in double precision with exact ends, for every one that is not the
/// reference's. Also for counts of blended fragments that differ from these images'.
std::vector<std::string> wrong_images(const Finished& run);

} // namespace degs::trials
