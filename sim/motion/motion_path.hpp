// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {

/// Where the views of a path come from.
struct MotionRequest {
    ViewRequest view;      ///< the camera is the first one
    std::string poses;     ///< file of recorded poses; empty: through the cameras from the first on
    GroupRequest eyes;     ///< of the head; its scene units for a metre are those of the poses, too
    bool in_scene = false; ///< poses are those of the camera in the scene
    int between = 0;       ///< frames between two cameras
    std::optional<int> frames; ///< at most; empty: all
};

struct MotionPath {
    std::vector<double> times_s; ///< from 0 on
    std::vector<Camera> cameras; ///< in the size of the view
};

/// The views at multiples of 1 / `hz`. Throws InputError for mistakes in the request.
MotionPath motion_path(const MotionRequest& request, const Scene& scene, double hz);

} // namespace degs::sim
