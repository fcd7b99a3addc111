// SPDX-License-Identifier: Apache-2.0
// The one place that turns options of frames and views into cameras.
#pragma once

#include <functional>
#include <vector>

#include "sim/view/view.hpp"

namespace degs::sim {

/// Where the cameras of a path come from.
struct PathSource {
    int camera = 0;                              ///< position of the first in the scene's list
    std::function<Camera(int)> camera_at;        ///< by position, in the size of the images
    bool stands_still = false;                   ///< the scene changes in place of the camera
    std::function<const GaussianCloud&()> cloud; ///< asked for only if the camera turns about it
};

/// The cameras of all frames of a path; the views of a frame follow each other. Throws InputError
/// for a position that does not exist.
std::vector<Camera> cameras_of_frames(const PathRequest& path, const PathSource& source);

/// The cameras of the views of one frame of the scene, in the size of the request. Throws
/// InputError likewise.
std::vector<Camera> cameras_of_frame(const ViewRequest& request, const GroupRequest& group,
                                     const Scene& scene);

} // namespace degs::sim
