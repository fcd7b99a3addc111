// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "splat/model/camera.hpp"

namespace degs {

/// What a camera file holds.
struct CameraFile {
    std::vector<Camera> cameras;    ///< never empty
    std::vector<std::string> notes; ///< a full sentence for everything that is left out or assumed
    /// Cameras are in the coordinates of the original data (transforms.json, COLMAP), which those
    /// of a scene may differ from; see trained_frame.hpp. Others are in those of the scene.
    bool of_original_data = false;
    bool generated =
        false; ///< some view was generated for a scene without cameras, and no file holds it
};

/// Reads cameras.json of the original 3DGS code, transforms.json of nerfstudio or instant-ngp, or a
/// COLMAP model (its folder or one of its files). The content decides which it is. Throws
/// InputError with the file, the entry and the key for every value outside the rules of
/// docs/cameras.md.
CameraFile read_camera_file(const std::string& path);

/// The name of the camera file of one scene alone: STEM.cameras.json in the folder of the scene
/// file.
std::string own_camera_file(const std::string& scene_file);

/// The camera file that belongs to a scene file: its own_camera_file(), else cameras.json,
/// transforms.json or a COLMAP model in sparse/0 in its folder, else one of these in the folder of
/// the model where the original training code wrote the scene
/// (MODEL/point_cloud/iteration_N/point_cloud.ply). Empty if there is none.
std::string cameras_beside(const std::string& scene_file);

/// Every file that read_camera_file() would read for `path`; without any message, also if it is
/// missing.
std::vector<std::string> files_of_cameras(const std::string& path);

/// Whether `file` has the name that the original training code gives to a scene, in a folder
/// iteration_N.
bool is_training_output(const std::string& file);

} // namespace degs
