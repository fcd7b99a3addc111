// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "scene/scene.hpp"
#include "scene/scene_statistics.hpp"

namespace degs::sim {

/// Writes the scene in the format of the file's extension, and its cameras to own_camera_file(). A
/// generated view is not written. Throws InputError if the camera file holds others and either the
/// scene has none or another scene of this folder is drawn with them.
void write_scene(const Scene& scene, const std::string& file);

/// Writes a scene and its cameras, but leaves the file of the scene to `write`; `words` describe
/// what that file holds, and `cameras` are the cameras of the scene itself (empty: it has none).
void write_scene(const std::string& file, const std::string& words,
                 const std::vector<Camera>& cameras, const std::function<void()>& write);

/// What `scene info` tells of a scene, as a document.
nlohmann::ordered_json scene_info_json(const Scene& scene);
/// What it tells of a view.
nlohmann::ordered_json view_info_json(const ViewStatistics& v, const Camera& camera);

/// Renders the view with the reference renderer, in double precision, as a PNG. Returns what was
/// culled.
CullCounts write_preview(const Scene& scene, const Camera& camera, const ProjectionOptions& options,
                         const std::string& file);

} // namespace degs::sim
