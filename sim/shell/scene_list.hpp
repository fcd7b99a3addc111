// SPDX-License-Identifier: Apache-2.0
// Scenes separated by commas; the names of synthetic scenes may contain commas as well.
#pragma once

#include <string>
#include <vector>

namespace degs::sim {

/// Cuts every word at its commas, but neither an existing file's name nor in front of a setting of
/// a scene: "a.spz?axes=rdf,synthetic:object,seed=2,b.ply" are three. Empty names are kept, so
/// that loading them reports the mistake.
std::vector<std::string> split_scenes(const std::vector<std::string>& words);

} // namespace degs::sim
