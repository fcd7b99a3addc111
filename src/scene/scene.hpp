// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/files/scene_content.hpp"

namespace degs {

struct Scene {
    std::string name;               ///< short, for reports: of the file, its folder or the profile
    std::string source;             ///< what the user wrote
    GaussianCloud cloud;            ///< sanitized and not empty
    std::vector<Camera> cameras;    ///< never empty: scenes without cameras get an orbit view
    bool generated_view = false;    ///< `cameras` is an orbit view, or a file says that it was one
    SanitizeReport dropped;         ///< what was not drawable
    SceneTraits traits;             ///< how the file wants to be drawn
    std::vector<std::string> notes; ///< a full sentence for everything guessed or passed over
};

/// Loads `spec` (see parse_scene_spec): a scene file of any of the scene_formats(), with options
/// behind its name, or "synthetic:NAME[,gaussians=N][,seed=N]"; of a scene that changes
/// (open_dynamic_scene) the first frame, or the time that the spec names. World axes become RDF.
/// Cameras come from `cameras_path` if given, else from cameras_beside() the file, else from the
/// file itself. Throws InputError for every mistake in the input, also for a scene without a
/// drawable Gaussian.
Scene load_scene(const std::string& spec, const std::string& cameras_path = "");

/// The name that `load_scene` would give to the scene. InputError if no synthetic scene is called
/// so.
std::string scene_name(const std::string& spec);

/// Number of cameras that `load_scene` would find, without reading the Gaussians of a file. Throws
/// InputError if the scene or its cameras cannot be read.
std::size_t camera_count(const std::string& spec, const std::string& cameras_path = "");

/// Returns a camera by its position in `scene.cameras`. InputError if it does not exist.
Camera select_camera(const Scene& scene, int index);

} // namespace degs
