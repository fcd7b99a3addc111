// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "splat/model/camera.hpp"

namespace degs {

/// The cameras that `load_scene` would find, without reading the Gaussians of a file; empty if it
/// would generate a view. They may lie in other coordinates. Throws InputError if the scene or its
/// cameras cannot be read.
std::vector<Camera> cameras_of_scene(const std::string& spec, const std::string& cameras_path = "");

} // namespace degs
