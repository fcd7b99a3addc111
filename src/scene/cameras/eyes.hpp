// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/model/camera.hpp"

namespace degs {

/// The left and the right eye of a head whose middle is a camera: each is half of `distance` (scene
/// units) away along the camera's x axis, and both look along parallel axes. Size and lens stay.
std::vector<Camera> eyes_of(const Camera& middle, double distance);

/// The point in the middle of cameras, of which there is one at least.
glm::dvec3 middle_of(const std::vector<Camera>& cameras);

} // namespace degs
