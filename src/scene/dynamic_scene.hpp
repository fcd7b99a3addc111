// SPDX-License-Identifier: Apache-2.0
// Scenes that change from frame to frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "splat/model/gaussian.hpp"

namespace degs {

/// Frames per length of a scene whose Gaussians are functions of time, unless its name says another
/// number: SpacetimeGaussians trains sections of 50. Frame k of N is at time k / N.
constexpr int kFramesOfScene = 50;

class DynamicScene {
public:
    virtual ~DynamicScene() = default;
    virtual int frames() const = 0;
    /// What can be drawn of frame `k`, 0 <= k < frames(). InputError for a file that cannot be
    /// read.
    virtual GaussianCloud frame(int k) const = 0;
};

/// The frames of a scene, or null if it is static: a sequence of files, a file of
/// SpacetimeGaussians or synthetic:dynamic, unless the name of the scene says at what time.
/// InputError for a pattern that no file matches.
std::unique_ptr<DynamicScene> open_dynamic_scene(const std::string& spec);

/// The files of a sequence in natural order (2 before 10): those that match the name behind the
/// last
/// '/', in which '*' stands for any characters, or the scene files of a folder. Empty if `path` is
/// neither a pattern nor a folder. InputError if nothing matches.
std::vector<std::string> sequence_files(const std::string& path);

} // namespace degs
