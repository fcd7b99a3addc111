// SPDX-License-Identifier: Apache-2.0
// The readers behind read_camera_file().
#pragma once

#include <string>
#include <vector>

#include "scene/cameras/camera_file.hpp"

namespace degs {

/// cameras.json of the original 3DGS code: an array of {width, height, position, rotation, fx, fy}
/// with optional id, img_name, camera_model and distortion. `rotation` holds the rows of the
/// camera-to-world matrix. Reading takes at most 12 bytes of memory per byte of the file, the
/// cameras included.
CameraFile read_cameras_json(const std::string& path);

/// transforms.json of nerfstudio and instant-ngp: intrinsics, which a frame may have of its own,
/// and `frames`, whose transform_matrix is camera-to-world with the axes of OpenGL (x right, y up,
/// z back). An applied_transform and an applied_scale are undone. Memory as for cameras.json.
CameraFile read_transforms_json(const std::string& path);

/// The files of a COLMAP model: cameras and images, both .bin or both .txt.
struct ColmapFiles {
    std::string cameras, images;
    bool binary = false;
};

/// The files of a COLMAP model in a folder, or in sparse/0 or 0 inside it; binary files first, as
/// COLMAP itself prefers them. Empty names if there are none.
ColmapFiles colmap_in(const std::string& folder);

/// The views of a COLMAP model in the order of their names, as the original 3DGS code sorts them.
/// Lenses that OpenCV does not have are refused. Reading takes at most 12 bytes of memory per byte
/// of the two files.
CameraFile read_colmap(const ColmapFiles& files);

} // namespace degs
