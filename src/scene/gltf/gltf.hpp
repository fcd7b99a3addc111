// SPDX-License-Identifier: Apache-2.0
// Gaussian splats in glTF 2.0: KHR_gaussian_splatting (Khronos, release candidate of 2026-04-15).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/files/scene_content.hpp"

namespace degs {

/// Does the start of a file look like a GLB, or like the JSON of a .gltf?
bool is_gltf(std::string_view head);

/// Reads the splats of a .gltf or .glb: every primitive with KHR_gaussian_splatting, once per node
/// (and instance) that shows it, moved to world space; coordinates stay as they are. Cameras of the
/// nodes come along. Memory: at most twice the file, or once the file and 1.1 times what its
/// attributes take as floats, plus the Gaussians of the result, which may have 8 GiB. InputError
/// for everything that is not such a file.
SceneContent read_gltf(const std::string& path);

/// The cameras alone, without the Gaussians.
std::vector<Camera> read_gltf_cameras(const std::string& path);

/// A node that shows the cloud of a GLB: turned, then moved.
struct GlbInstance {
    std::string name;
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0, 0, 0, 1}; ///< unit quaternion x y z w, as glTF writes it
};

/// Writes a GLB with one mesh of one splat primitive (float attributes of KHR_gaussian_splatting),
/// a node for every instance (one without transform if there are none) and a node for every camera.
/// Coordinates stay as they are. Attributes keep their bits; only means are rounded to float.
/// Memory: 1 MB. InputError if the place cannot be written, the cloud is empty or the file would
/// reach 4 GiB, which GLB does not allow.
void write_glb(const GaussianCloud& cloud, const std::vector<Camera>& cameras,
               const std::vector<GlbInstance>& instances, const std::string& path);

} // namespace degs
