// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/frame/projection.hpp"
#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// Degrees per frame of a camera path [assumed]: 45 degrees a second, a brisk turn of the head, at
/// 90 frames a second, the refresh rate of a headset.
constexpr double kPathStepDegrees = 0.5;
constexpr double kMostPathStepDegrees = 90;

/// `frames` views (at least 1) of an orbit that starts at `start`: view k has turned by k x
/// `step_degrees` about the image's vertical axis through path_pivot(). Size and focal lengths
/// stay, and so do the distance to the pivot and its place in the middle of the image. View 0 is
/// `start`, bit by bit. InputError for fewer than 1 frame or a step outside +-90 degrees.
std::vector<Camera> camera_path(const GaussianCloud& cloud, const Camera& start, int frames,
                                double step_degrees = kPathStepDegrees,
                                double near_plane = ProjectionOptions().near_plane);

/// The point on the view axis at the median view depth of the Gaussians whose means the camera
/// sees: half of them are nearer, so that floaters and the sky move it little. A camera that sees
/// none takes the median distance of all means. It sees nothing at or before `near_plane` (scene
/// units). The cloud is not empty.
glm::dvec3 path_pivot(const GaussianCloud& cloud, const Camera& camera,
                      double near_plane = ProjectionOptions().near_plane);

} // namespace degs
