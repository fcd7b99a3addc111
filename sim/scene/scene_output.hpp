// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "scene/scene.hpp"

namespace degs::sim {

/// Writes the scene in the format of the file's extension and, unless there is one, cameras.json beside it.
void write_scene(const Scene& scene, const std::string& file);

/// The same with another way to write the file; `words` describe what it holds.
void write_scene(const std::string& file, const std::string& words,
                 const std::vector<Camera>& cameras, const std::function<void()>& write);

/// What `scene info` tells of a scene, as a document.
nlohmann::ordered_json scene_info_json(const Scene& scene);
/// What it tells of a view; renders the reference image once.
nlohmann::ordered_json view_info_json(const Scene& scene, const Camera& camera);

/// Renders the view with the reference renderer, in double precision, as a PNG.
void write_preview(const Scene& scene, const Camera& camera, const std::string& file);

} // namespace degs::sim
