// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/cameras/orbit_camera.hpp"
#include "splat/angles.hpp"

namespace degs {
namespace {

constexpr double kNearPlane = 0.2; // scene units; the original rasteriser drops what is nearer

/// The value of this rank in ascending order; reorders them.
template <class Value>
Value ranked(std::vector<Value>& values, std::size_t rank) {
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[rank];
}

/// The middle 80 % of the means, per axis.
struct Middle {
    glm::dvec3 centre{0.0};
    double radius = 0; ///< half the diagonal, at least the size of a typical Gaussian
};

Middle middle_of(const GaussianCloud& cloud) {
    Middle middle;
    glm::dvec3 half(0.0);
    std::vector<double> values(cloud.size());
    const std::size_t tenth = (cloud.size() - 1) / 10;
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            values[i] = cloud.means[i][axis];
        }
        const double low = ranked(values, tenth);
        const double high = ranked(values, values.size() - 1 - tenth);
        middle.centre[axis] = low + (high - low) / 2;
        half[axis] = (high - low) / 2;
    }
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const glm::vec3& scale = cloud.scales[i];
        values[i] = std::max({scale.x, scale.y, scale.z});
    }
    middle.radius = std::max(glm::length(half), 3 * ranked(values, values.size() / 2));
    return middle;
}

} // namespace

Camera looking_at(const glm::dvec3& position, const glm::dvec3& target) {
    const glm::dvec3 down(0, 1, 0);
    const glm::dvec3 forward = glm::normalize(target - position);
    glm::dvec3 right = glm::cross(down, forward);
    if (!(glm::length(right) > 1e-9)) { // straight up or down
        right = {1, 0, 0};
    }
    right = glm::normalize(right);
    Camera camera;
    camera.position = position;
    camera.camera_to_world = {right, glm::cross(forward, right), forward};
    return camera;
}

Camera orbit_camera(const GaussianCloud& cloud, const OrbitOptions& options) {
    const Middle middle = middle_of(cloud);
    const double focal =
        options.width / (2 * std::tan(options.field_of_view_degrees * kDegree / 2));
    const double half_angle = std::atan(std::min(options.width, options.height) / (2 * focal));
    const double distance = std::max(options.distance * middle.radius / std::sin(half_angle),
                                     middle.radius + 2 * kNearPlane);
    const double azimuth = options.azimuth_degrees * kDegree;
    const double elevation = options.elevation_degrees * kDegree;
    const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), -std::sin(elevation),
                               -std::cos(elevation) * std::cos(azimuth));
    Camera camera = looking_at(middle.centre + distance * direction, middle.centre);
    camera.name = "orbit";
    camera.width = options.width;
    camera.height = options.height;
    camera.fx = camera.fy = focal;
    return camera;
}

} // namespace degs
