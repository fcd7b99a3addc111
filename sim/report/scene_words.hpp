// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/scene_statistics.hpp"
#include "sim/report/terminal.hpp"

namespace degs::sim {

/// "(1.2, -0.35, 4)"
std::string point_words(const glm::dvec3& p);
/// Describes a scene and its cameras.
std::string scene_info(const Scene& scene);
/// Describes the work of a view.
std::string view_info(const ViewStatistics& v, const Camera& camera);

} // namespace degs::sim
