// SPDX-License-Identifier: Apache-2.0
// What is rendered, from where and how large: the options that all commands with a scene share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "scene/scene.hpp"

namespace degs::sim {

struct ViewRequest {
    std::string scene;
    std::string cameras; ///< file, empty: the scene's own
    int camera = 0;
    std::optional<int> width, height;
};

struct View {
    Scene scene;
    Camera camera;
    double load_s = 0;
};

/// 8K UHD; images, the reference and their comparison take some 100 B per pixel.
constexpr std::int64_t kMostPixels = std::int64_t{7680} * 4320;

/// Adds --scene, --cameras, --camera, --width and --height.
void add_view_options(CLI::App& command, ViewRequest& request);

/// Loads the scene and resizes the camera. Throws InputError.
View load_view(const ViewRequest& request);

/// Width alone or height alone scales the view; both give the image that size at the scale of the
/// width, so that another aspect ratio shows more or less above and below. Throws InputError.
Camera resize(const Camera& camera, std::optional<int> width, std::optional<int> height);

} // namespace degs::sim
