// SPDX-License-Identifier: Apache-2.0
#include "splat/model/camera.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

constexpr int kMaxSide = 65536; // px, as in cameras.json

} // namespace

std::optional<double> Camera::seen_depth(const glm::dvec3& point) const {
    const glm::dvec3 seen = glm::transpose(camera_to_world) * (point - position);
    const bool inside = seen.z > 0 && std::abs(seen.x) <= width / (2 * fx) * seen.z &&
                        std::abs(seen.y) <= height / (2 * fy) * seen.z;
    return inside ? std::optional<double>(seen.z) : std::nullopt;
}

Camera Camera::scaled_to_width(int new_width) const {
    const double factor = ratio_of(new_width, width);
    const double new_height = std::max(1.0, std::round(height * factor));
    // Phrased so that a camera without pixels (factor infinite or NaN) fails too.
    if (!(new_width >= 1 && new_width <= kMaxSide && width >= 1 && height >= 1 &&
          new_height <= kMaxSide)) {
        throw InputError("Camera " + std::to_string(id) + " of " + std::to_string(width) + " x " +
                         std::to_string(height) + " pixels cannot be scaled to a width of " +
                         std::to_string(new_width) + "; width and height must lie in 1 .. " +
                         std::to_string(kMaxSide) + " pixels.");
    }
    Camera scaled = *this;
    scaled.width = new_width;
    scaled.height = static_cast<int>(new_height);
    scaled.fx = fx * factor;
    scaled.fy = fy * factor;
    return scaled;
}

} // namespace degs
