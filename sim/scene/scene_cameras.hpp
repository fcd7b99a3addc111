// SPDX-License-Identifier: Apache-2.0
// degs scene cameras: the views of a scene, as text and as cameras.json.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "scene/scene.hpp"

namespace CLI {
class App;
}

namespace degs::sim {

void add_scene_cameras(CLI::App& scene);

/// cameras.json with these cameras; those of a generated view are marked `generated: true`.
nlohmann::ordered_json cameras_json(const std::vector<Camera>& cameras, bool generated);

/// A line for each camera: size, where it is, where it looks and how much it sees.
std::string cameras_text(const Scene& scene);

} // namespace degs::sim
