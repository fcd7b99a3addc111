// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// Which synthetic scene to make; see docs/synthetic-scenes.md.
struct SyntheticSpec {
    std::string profile;
    std::uint64_t gaussians = 0;
    std::uint64_t seed = 1;
    std::optional<double> time{}; ///< 0..1, of the profile that changes over time
    std::optional<int> frames{};  ///< per length of that profile
    double sky = 0;               ///< share of very large faint splats, of `interior` and `garden`
};

struct SyntheticScene {
    GaussianCloud cloud;
    /// overview 640x480, near 1280x720, closeup 1920x1080; of `interior` and `garden` 1440x1080 and
    /// twice 1920x1080.
    std::vector<Camera> cameras;
};

/// One row of the table of profiles.
struct SyntheticProfile {
    std::string name;
    std::string meaning;
    std::uint64_t default_gaussians = 0;
};
std::vector<SyntheticProfile> synthetic_profiles();

/// A time within a scene, a number from 0 to 1; nothing for any other text.
std::optional<double> parse_scene_time(const std::string& text);

/// The most frames that a scene which is a function of time can be cut into.
constexpr int kMostSceneFrames = 10000;
/// A number of frames, an integer from 1 to kMostSceneFrames; nothing for any other text.
std::optional<int> parse_scene_frames(const std::string& text);

/// Parses "NAME[,gaussians=N][,seed=N][,time=T][,frames=N][,sky=S]". InputError names the profiles,
/// keys and ranges.
SyntheticSpec parse_synthetic(const std::string& text);

/// Makes a scene. The same spec gives the same bytes on every platform with IEEE arithmetic
/// (nothing depends on the distributions of the standard library or the last bit of the C library's
/// exp). Sizes shrink as the count grows, so that coverage and depth complexity stay; below
/// 10 000 Gaussians only roughly.
SyntheticScene make_synthetic(const SyntheticSpec& spec);

} // namespace degs
