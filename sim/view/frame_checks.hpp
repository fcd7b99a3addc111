// SPDX-License-Identifier: Apache-2.0
// What a frame from a file must satisfy before a run relies on it.
#pragma once

#include "splat/frame/frame_workload.hpp"

namespace degs::sim {

/// The highest degree of spherical harmonics that a scene has.
constexpr int kMostShDegree = 3;
constexpr int kMostCameraSide = 65536; ///< px, as Camera::scaled_to_width

/// A camera that projects: sides within 1 .. 65536, finite numbers, axes at right angles.
bool is_sound(const Camera& camera);

/// The ranges that the numbers of a projection's splats have.
struct SplatLimits {
    explicit SplatLimits(const ProjectionOptions& options);
    double most_q, most_opacity;
};
/// A splat of which every number is finite and in its range.
bool is_sound(const ProjectedSplat& splat, const SplatLimits& limits);

/// Lists, counts and splats that fit each other and the camera of the frame, as
/// make_frame_workload() leaves them; every number is finite and in its range.
bool is_sound(const FrameWorkload& frame);

} // namespace degs::sim
