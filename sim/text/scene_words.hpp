// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sim/text/terminal.hpp"

namespace degs::sim {

/// What a scene is made of, and its cameras.
std::string scene_info(const Scene& scene);
/// What a view of it costs; renders the reference image once.
std::string view_info(const Scene& scene, const Camera& camera);

} // namespace degs::sim
