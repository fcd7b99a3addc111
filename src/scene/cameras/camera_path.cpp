// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/camera_path.hpp"

#include <algorithm>
#include <cmath>

#include "degs/error.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

/// View depths of the means that project into the image behind the near plane, of Gaussians that
/// are not transparent.
std::vector<double> depths_of(const GaussianCloud& cloud, const Camera& camera, double near_plane) {
    const double alpha_min = ProjectionOptions().alpha_min;
    std::vector<double> depths;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const std::optional<double> depth = camera.seen_depth(cloud.means[i]);
        if (depth && *depth > near_plane && cloud.opacities[i] >= alpha_min) {
            depths.push_back(*depth);
        }
    }
    return depths;
}

std::vector<double> distances_of(const GaussianCloud& cloud, const Camera& camera) {
    std::vector<double> distances;
    distances.reserve(cloud.size());
    for (const glm::dvec3& mean : cloud.means) {
        distances.push_back(glm::length(mean - camera.position));
    }
    return distances;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + values.size() / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// `v` turned about the unit vector `axis` (Rodrigues).
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
           (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
}

} // namespace

glm::dvec3 path_pivot(const GaussianCloud& cloud, const Camera& camera, double near_plane) {
    std::vector<double> depths = depths_of(cloud, camera, near_plane);
    if (depths.empty()) {
        depths = distances_of(cloud, camera);
    }
    return camera.position + median(std::move(depths)) * camera.camera_to_world[2];
}

std::vector<Camera> camera_path(const GaussianCloud& cloud, const Camera& start, int frames,
                                double step_degrees, double near_plane) {
    if (frames < 1) {
        throw InputError("A camera path of " + std::to_string(frames) +
                         " frames is not possible; at least 1 is needed.");
    }
    if (!(std::abs(step_degrees) <= kMostPathStepDegrees)) {
        throw InputError("A camera path turns by -90 to 90 degrees per frame, not by more.");
    }
    const glm::dvec3 pivot = path_pivot(cloud, start, near_plane);
    const glm::dvec3 axis = glm::normalize(start.camera_to_world[1]);
    std::vector<Camera> path(frames, start);
    for (int k = 1; k < frames; ++k) {
        Camera& camera = path[k];
        const double angle = k * step_degrees * kDegree;
        camera.position = pivot + turned(start.position - pivot, axis, angle);
        for (int a = 0; a < 3; ++a) {
            camera.camera_to_world[a] = turned(start.camera_to_world[a], axis, angle);
        }
    }
    return path;
}

} // namespace degs
