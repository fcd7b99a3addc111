// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/cameras/orbit_camera.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

constexpr double kNearPlane = 0.2; // scene units; the original rasteriser drops what is nearer

/// The value of this rank in ascending order; reorders them.
template <class Value>
Value ranked(std::vector<Value>& values, std::size_t rank) {
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[rank];
}

/// What a view of the scene shows.
struct Framed {
    glm::dvec3 centre{0.0};
    glm::dvec3 half{0.0}; ///< half the sides of the box
};

/// The larger side of a Gaussian's middle: what one sees of it ends about there.
double reach_of(const GaussianCloud& cloud, std::size_t i) {
    const glm::vec3& scale = cloud.scales[i];
    return 2 * static_cast<double>(std::max({scale.x, scale.y, scale.z}));
}

/// The least coordinate of what is seen of the Gaussians, without the first `tail` of them; with
/// `sign` -1 that of the mirrored scene.
double end_of(const GaussianCloud& cloud, int axis, double sign, std::size_t tail,
              std::vector<double>& values) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        values[i] = sign * cloud.means[i][axis] - reach_of(cloud, i);
    }
    return sign * ranked(values, tail);
}

Framed framed_part(const GaussianCloud& cloud) {
    Framed framed;
    std::vector<double> values(cloud.size());
    const std::size_t tenth = (cloud.size() - 1) / 10;
    const std::size_t hundredth = (cloud.size() - 1) / 100;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = end_of(cloud, axis, 1, tenth, values);
        const double high = end_of(cloud, axis, -1, tenth, values);
        const double beyond = (high - low) / 2;
        const double least = std::max(end_of(cloud, axis, 1, hundredth, values), low - beyond);
        const double most = std::min(end_of(cloud, axis, -1, hundredth, values), high + beyond);
        framed.centre[axis] = least + (most - least) / 2;
        framed.half[axis] = std::max((most - least) / 2, 0.0);
    }
    return framed;
}

/// From how far away a camera with this rotation sees all corners of the box inside the image.
double fitting_distance(const glm::dvec3& half, const Camera& camera) {
    constexpr double kRim = 0.9; // of the image's width and height
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 signs((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                               (corner & 4) != 0 ? 1 : -1);
        const glm::dvec3 seen = glm::transpose(camera.camera_to_world) * (signs * half);
        distance =
            std::max({distance, std::abs(seen.x) * 2 * camera.fx / (kRim * camera.width) - seen.z,
                      std::abs(seen.y) * 2 * camera.fy / (kRim * camera.height) - seen.z,
                      2 * kNearPlane - seen.z});
    }
    return distance;
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

OrbitView orbit_view(const GaussianCloud& cloud, const OrbitOptions& options) {
    const Framed framed = framed_part(cloud);
    const double azimuth = options.azimuth_degrees * kDegree;
    const double elevation = options.elevation_degrees * kDegree;
    const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), -std::sin(elevation),
                               -std::cos(elevation) * std::cos(azimuth));
    Camera camera = looking_at(direction, glm::dvec3(0.0));
    camera.name = "orbit";
    camera.width = options.width;
    camera.height = options.height;
    camera.fx = camera.fy =
        options.width / (2 * std::tan(options.field_of_view_degrees * kDegree / 2));
    camera.position =
        framed.centre + options.distance * fitting_distance(framed.half, camera) * direction;
    return {camera, framed.centre};
}

Camera orbit_camera(const GaussianCloud& cloud, const OrbitOptions& options) {
    return orbit_view(cloud, options).camera;
}

glm::dvec2 field_of_view(const Camera& camera) {
    return {2 * std::atan(camera.width / (2 * camera.fx)) / kDegree,
            2 * std::atan(camera.height / (2 * camera.fy)) / kDegree};
}

} // namespace degs
