// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/camera_place.hpp"

#include <cmath>

#include "scene/files/input_file.hpp"

namespace degs {
namespace {

constexpr double kOrthonormality = 1e-3; // largest deviation of an entry of R^T R from identity

} // namespace

void CameraPlace::fail(const std::string& sentence) const {
    fail_file(path_, entry_ + " " + sentence);
}

int checked_side(const CameraPlace& place, const std::string& name, double value,
                 const std::string& text) {
    if (!(value >= 1 && value <= kMostCameraSide) || value != std::floor(value)) {
        place.fail("has a " + name + " of " + text + "; allowed are integers from 1 to " +
                   std::to_string(kMostCameraSide) + ".");
    }
    return static_cast<int>(value);
}

double checked_focal_length(const CameraPlace& place, const std::string& name, double value,
                            const std::string& text) {
    if (!(value > 0 && value <= kMostFocalLength)) {
        place.fail("has a focal length " + name + " of " + text +
                   "; allowed are more than 0 and at most 1e9 pixels.");
    }
    return value;
}

void check_rotation(const CameraPlace& place, const std::string& name, const glm::dmat3& matrix) {
    const glm::dmat3 product = glm::transpose(matrix) * matrix;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (!(std::abs(product[i][j] - (i == j ? 1 : 0)) <= kOrthonormality)) {
                place.fail("has a " + name +
                           " whose rows are not orthogonal unit vectors within 1e-3.");
            }
        }
    }
    if (!(glm::determinant(matrix) > 0)) {
        place.fail("has a " + name +
                   " that mirrors (determinant -1); only proper rotations are allowed.");
    }
}

void set_principal_point(const CameraPlace& place, double cx, double cy, Camera& camera) {
    if (!camera.set_principal_point({cx, cy})) {
        place.fail("has a principal point at " + std::to_string(cx) + ", " + std::to_string(cy) +
                   ", too far from the middle of its image; a centred image that holds it may have "
                   "at most " +
                   std::to_string(kMostRasterSide) + " pixels to a side.");
    }
}

} // namespace degs
