// SPDX-License-Identifier: Apache-2.0
// Scenes separated by commas, whose names may contain commas as well, and how they are called
// beside each other.
#pragma once

#include <string>
#include <vector>

#include "sim/view/view.hpp"

namespace degs::sim {

/// Cuts every word at its commas, but neither an existing file's name nor in front of a setting of
/// a scene: "a.spz?axes=rdf,synthetic:object,seed=2,b.ply" are three. Empty names are kept, so
/// that loading them reports the mistake.
std::vector<std::string> split_scenes(const std::vector<std::string>& words);

/// How the scenes are called where they are shown together: by their scene_name(), and where
/// several share it with the shortest part of folders, file and settings that tells them apart:
/// "cup/splat" and "vase/splat", "object gaussians=300" and "object gaussians=900". Different words
/// have different labels.
std::vector<std::string> scene_labels(const std::vector<std::string>& scenes);
/// The labels of the scenes of views, which may share one.
std::vector<std::string> scene_labels(const std::vector<ViewRequest>& views);

} // namespace degs::sim
