// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "splat/model/camera.hpp"

namespace degs {

/// Where a head or a camera is at a time: a rotation and a translation to the world from view axes
/// that are x right, y up and z back, as OpenXR has them.
struct Pose {
    double time_s = 0;
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< of length 1
};

/// Reads recorded poses from a CSV file. Its first line names the columns: time_s, x, y, z, qw, qx,
/// qy and qz in any order; others are skipped. Throws InputError, which names the line, for a
/// column that is missing or given twice, anything but a finite number, times that do not rise and
/// quaternions whose length is not 1 within 1e-3.
std::vector<Pose> read_poses(const std::string& file);

/// The pose between the two that surround the time: positions in a straight line, rotations by the
/// shorter turn at constant speed (slerp). Before the first and after the last pose it is that one.
/// `poses` is not empty.
Pose pose_at(const std::vector<Pose>& poses, double time_s);

/// The pose of a camera.
Pose pose_of(const Camera& camera, double time_s);
/// The camera at another place; its size, lens and number stay.
Camera placed(const Camera& camera, const Pose& pose);

/// The poses as a movement that starts at another one: the same turns and the same ways, the latter
/// times `scale`.
std::vector<Pose> started_at(const std::vector<Pose>& poses, const Pose& start, double scale);

} // namespace degs
