// SPDX-License-Identifier: Apache-2.0
#include "scene/npz/npz_cameras.hpp"

#include <algorithm>
#include <cmath>

#include "scene/files/input_file.hpp"
#include "scene/npz/npy_array.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMaxCameraBytes = 1 << 26; ///< of one array
constexpr double kMaxCameraSide = 65536;           ///< px

NpyArray camera_array(const ZipArchive& archive, const std::string& name) {
    return parse_npy(archive.path(), name, archive.read(name + ".npy", kMaxCameraBytes));
}

NpyArray square_matrices(const ZipArchive& archive, const std::string& name, std::uint64_t side) {
    NpyArray array = camera_array(archive, name);
    if (array.shape.size() != 3 || array.shape[1] != side || array.shape[2] != side) {
        const std::string n = std::to_string(side);
        fail_file(archive.path(), "its array '" + name + "' has the shape " + array.shape_words() +
                                      ", but (C, " + n + ", " + n + ") is needed.");
    }
    return array;
}

/// Width or height of a camera, from an array with one number for all cameras or one for each.
int side_of(const ZipArchive& archive, const NpyArray& array, const std::string& name,
            std::uint64_t camera, std::uint64_t cameras) {
    if (array.size() > 1 && array.size() != cameras) {
        fail_file(archive.path(), "its array '" + name + "' holds " + std::to_string(array.size()) +
                                      " numbers; allowed are one, or one for each of its " +
                                      std::to_string(cameras) + " cameras.");
    }
    const double side = array.size() == 0 ? 0 : array.at(array.size() == 1 ? 0 : camera);
    if (!(side >= 1 && side <= kMaxCameraSide) || side != std::floor(side)) {
        fail_file(archive.path(),
                  "its array '" + name + "' must hold whole numbers from 1 to 65536.");
    }
    return static_cast<int>(side);
}

void place(const ZipArchive& archive, const NpyArray& viewmats, std::uint64_t index,
           Camera& camera) {
    glm::dmat3 world_to_camera(1.0);
    glm::dvec3 shift(0.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            world_to_camera[column][row] = viewmats.at(16 * index + 4 * row + column);
        }
        shift[row] = viewmats.at(16 * index + 4 * row + 3);
    }
    const glm::dmat3 product = world_to_camera * glm::transpose(world_to_camera);
    bool orthonormal = std::isfinite(glm::dot(shift, shift));
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            constexpr double kTolerance = 1e-3;
            orthonormal = orthonormal && std::abs(product[column][row] - (row == column ? 1 : 0)) <=
                                             kTolerance; // false for NaN
        }
    }
    if (!orthonormal) {
        fail_file(archive.path(), "matrix " + std::to_string(index) +
                                      " of its array 'viewmats' is no rotation and translation.");
    }
    camera.camera_to_world = glm::transpose(world_to_camera);
    camera.position = -(camera.camera_to_world * shift);
}

} // namespace

std::vector<Camera> read_npz_cameras(const ZipArchive& archive) {
    std::vector<Camera> cameras;
    if (!archive.has("viewmats.npy")) {
        return cameras;
    }
    const NpyArray viewmats = square_matrices(archive, "viewmats", 4);
    const NpyArray intrinsics = square_matrices(archive, "Ks", 3);
    const NpyArray width = camera_array(archive, "width"), height = camera_array(archive, "height");
    if (intrinsics.shape[0] != viewmats.shape[0]) {
        fail_file(archive.path(), "it has " + std::to_string(viewmats.shape[0]) +
                                      " matrices 'viewmats', but " +
                                      std::to_string(intrinsics.shape[0]) + " 'Ks'.");
    }
    for (std::uint64_t i = 0; i < viewmats.shape[0]; ++i) {
        Camera camera;
        camera.id = static_cast<int>(i);
        camera.name = "view " + std::to_string(i);
        camera.width = side_of(archive, width, "width", i, viewmats.shape[0]);
        camera.height = side_of(archive, height, "height", i, viewmats.shape[0]);
        camera.fx = intrinsics.at(9 * i);
        camera.fy = intrinsics.at(9 * i + 4);
        if (!(camera.fx > 0 && camera.fy > 0 && std::isfinite(camera.fx + camera.fy))) {
            fail_file(archive.path(), "matrix " + std::to_string(i) +
                                          " of its array 'Ks' has no positive focal lengths.");
        }
        if (!camera.set_principal_point({intrinsics.at(9 * i + 2), intrinsics.at(9 * i + 5)})) {
            fail_file(archive.path(), "matrix " + std::to_string(i) +
                                          " of its array 'Ks' has a principal point too far from "
                                          "the middle of the image.");
        }
        place(archive, viewmats, i, camera);
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

std::vector<Camera> read_npz_cameras(const std::string& path) {
    return read_npz_cameras(ZipArchive(path));
}

} // namespace degs
