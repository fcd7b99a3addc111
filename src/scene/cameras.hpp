// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "splat/camera.hpp"
#include "splat/gaussian.hpp"

namespace degs {

/// Reads cameras.json of the original 3DGS code: an array of {width, height, position, rotation, fx, fy}
/// with optional id and img_name. `rotation` holds the rows of the camera-to-world matrix. Throws
/// InputError with the file, the entry and the key for every value outside the rules of docs/cameras.md.
/// Reading takes at most 12 bytes of memory per byte of the file, the cameras included.
std::vector<Camera> read_cameras(const std::string& path);

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
