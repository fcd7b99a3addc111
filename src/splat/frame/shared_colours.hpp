// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/frame/frame_workload.hpp"

namespace degs {

/// Gives the splats of a frame of `cloud` the colours that they have from `position` (world), in
/// the format of the frame's projection. Views of one frame that evaluate SH once have them from
/// the middle of the views.
void shade_from(const GaussianCloud& cloud, const glm::dvec3& position, FrameWorkload& frame);

} // namespace degs
