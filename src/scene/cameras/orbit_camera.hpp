// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/camera.hpp"
#include "splat/gaussian.hpp"

namespace degs {

/// The view of `orbit_camera` on a scene that has no cameras of its own.
struct OrbitOptions {
    double azimuth_degrees = 30;
    double elevation_degrees = 20;
    double distance = 1; ///< times the distance from which the middle of the scene fits the image
    double field_of_view_degrees = 50; ///< horizontal
    int width = 1280;                  ///< px
    int height = 720;                  ///< px
};

/// A view at the centre of the middle 80 % of the means (per axis), far enough for these to fit. Up
/// is -y, as in scenes from COLMAP. The cloud is not empty.
Camera orbit_camera(const GaussianCloud& cloud, const OrbitOptions& options = {});

/// A camera at `position` that looks at `target`, -y up; only the pose is set. The two points
/// differ; looking straight up or down is allowed.
Camera looking_at(const glm::dvec3& position, const glm::dvec3& target);

} // namespace degs
