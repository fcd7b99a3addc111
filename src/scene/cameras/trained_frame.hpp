// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/cameras/camera_file.hpp"

namespace degs {

/// The file in which nerfstudio's ns-export says how a scene lies to the data that it was trained
/// on: dataparser_transforms.json in the folder of the scene. Empty if there is none.
std::string trained_frame_beside(const std::string& scene_file);

/// Moves cameras in the coordinates of the original data into those of the scene, q = scale
/// (transform p), with a note; others stay. `path` is a file of trained_frame_beside(), or empty.
/// Throws InputError unless it has a `transform` of a rotation, a uniform scale and a translation,
/// and a positive `scale`.
void move_into_trained_frame(const std::string& path, CameraFile& file);

} // namespace degs
