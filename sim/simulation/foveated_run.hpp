// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/simulation/simulation.hpp"

namespace degs::sim {

/// Composes the images of the first frame from those of its views, which are the levels of `views`,
/// image by image.
void put_foveation(const FoveatedViews& views, RunResult& result);

/// Compares these images: `levels` are the references of the views, `full` those of the images
/// without foveation.
void judge_foveation(RunResult& result, const std::vector<Reference>& levels,
                     const std::vector<Reference>& full);

/// Pixels of a frame that its views draw, overlaps included.
std::uint64_t drawn_pixels(const RunResult& result);

} // namespace degs::sim
