// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <glm/glm.hpp>

namespace degs {

/// A pinhole camera in the convention of the original 3DGS code. The view axes are x right, y down
/// and z forward, the principal point is the image centre, and a pixel is sampled at its centre.
struct Camera {
    int id = 0;
    std::string name;
    int width = 0;                   ///< pixels
    int height = 0;                  ///< pixels
    double fx = 0;                   ///< focal length, pixels of `width`
    double fy = 0;                   ///< focal length, pixels of `height`
    glm::dvec3 position{0.0};        ///< camera centre in world space
    glm::dmat3 camera_to_world{1.0}; ///< columns are the view axes in world space

    /// View z of a point in front of the camera that projects into the image, edges included; none
    /// of any other point.
    std::optional<double> seen_depth(const glm::dvec3& point) const;
    std::uint64_t pixels() const { return std::uint64_t{1} * width * height; }
    /// This view at another width; height and focal lengths follow, height is rounded (at least
    /// 1). Throws InputError if either side leaves 1 .. 65536.
    Camera scaled_to_width(int new_width) const;
};

} // namespace degs
