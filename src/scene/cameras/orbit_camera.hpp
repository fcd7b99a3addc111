// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// The view of `orbit_camera` on a scene that has no cameras of its own.
struct OrbitOptions {
    double azimuth_degrees = 30;
    double elevation_degrees = 20;
    double distance = 1;               ///< times the distance from which the scene fits the image
    double field_of_view_degrees = 50; ///< horizontal
    int width = 1280;                  ///< px
    int height = 720;                  ///< px
};

struct OrbitView {
    Camera camera;
    glm::dvec3 target{0.0}; ///< what it looks at, in the middle of the image
};

/// A view of the whole scene: the box that holds the middle 98 % of the Gaussians on each axis,
/// each with two standard deviations of its largest axis, fits into the image with a rim of 5 %. A
/// scene that reaches far beyond its middle 80 % (surroundings, floaters) counts up to twice as far
/// as these. Up is -y, as in scenes from COLMAP. The cloud is not empty.
OrbitView orbit_view(const GaussianCloud& cloud, const OrbitOptions& options = {});
Camera orbit_camera(const GaussianCloud& cloud, const OrbitOptions& options = {});

/// A camera at `position` that looks at `target`, -y up; only the pose is set. The two points
/// differ; looking straight up or down is allowed.
Camera looking_at(const glm::dvec3& position, const glm::dvec3& target);

/// Degrees that the image sees to the left and right, and up and down, together.
glm::dvec2 field_of_view(const Camera& camera);

} // namespace degs
