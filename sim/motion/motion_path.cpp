// SPDX-License-Identifier: Apache-2.0
#include "sim/motion/motion_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ratio.hpp"
#include "degs/error.hpp"
#include "scene/cameras/pose_path.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

// Each frame is at least one run; a typing error should not ask for a million of them.
constexpr int kMostFrames = 10000;

/// The first camera at the place of another one: a display has one size and one lens.
Camera moved_to(Camera first, const Camera& other) {
    first.position = other.position;
    first.camera_to_world = other.camera_to_world;
    return first;
}

int checked_count(double frames, const std::optional<int>& most) {
    const double count = most ? std::min<double>(frames, *most) : frames;
    if (count > kMostFrames) {
        throw InputError("The path has " + scaled(count) + " frames, but at most " +
                         std::to_string(kMostFrames) +
                         " are possible; --frames takes the first ones.");
    }
    return static_cast<int>(count);
}

/// The poses at multiples of 1 / hz, as long as there are some.
std::vector<Pose> sampled(const std::vector<Pose>& poses, double hz,
                          const std::optional<int>& most) {
    const double seconds = poses.back().time_s - poses.front().time_s;
    constexpr double kSlack = 1e-9; // of the last date, beside what its number resolves
    const double resolved = 2 * std::numeric_limits<double>::epsilon() *
                            std::max(std::abs(poses.front().time_s), std::abs(poses.back().time_s));
    const int count = checked_count(std::floor((seconds + resolved) * hz + kSlack) + 1, most);
    std::vector<Pose> views;
    views.reserve(count);
    for (int k = 0; k < count; ++k) {
        views.push_back(pose_at(poses, poses.front().time_s + k / hz));
    }
    return views;
}

MotionPath along_poses(const MotionRequest& request, const Scene& scene, double hz) {
    const Camera first = camera_of(request.view, scene);
    std::vector<Pose> poses = read_poses(request.poses);
    if (!request.in_scene) {
        poses = started_at(poses, pose_of(first, 0), request.eyes.units_per_metre);
    }
    MotionPath path;
    for (const Pose& pose : sampled(poses, hz, request.frames)) {
        path.cameras.push_back(placed(first, pose));
    }
    if (!request.in_scene) {
        path.cameras.front() = first; // bit by bit
    }
    return path;
}

MotionPath along_cameras(const MotionRequest& request, const Scene& scene) {
    const int steps = request.between + 1;
    const double pairs = real_of(scene.cameras.size()) - 1 - request.view.camera;
    const double frames = std::max(pairs, 0.0) * steps + 1;
    const int count = checked_count(frames, request.frames);
    const Camera first = camera_of(request.view, scene);
    MotionPath path;
    for (int k = 0; k < count; ++k) {
        const auto before = scene.cameras.begin() + request.view.camera + k / steps;
        path.cameras.push_back(
            k % steps == 0
                ? moved_to(first, *before)
                : placed(first,
                         pose_at({pose_of(*before, 0), pose_of(*(before + 1), steps)}, k % steps)));
    }
    return path;
}

} // namespace

MotionPath motion_path(const MotionRequest& request, const Scene& scene, double hz) {
    MotionPath path =
        request.poses.empty() ? along_cameras(request, scene) : along_poses(request, scene, hz);
    int frame = 0;
    for (Camera& camera : path.cameras) {
        path.times_s.push_back(frame / hz);
        camera.id = frame;
        camera.name = "frame " + std::to_string(frame++);
    }
    return path;
}

} // namespace degs::sim
