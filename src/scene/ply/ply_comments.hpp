// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/files/scene_content.hpp"

namespace degs {

/// Takes from the comments of a PLY header what has a meaning: "SplatRenderMode: default|mip|2dgs",
/// "antialiased 0|1" and "Vertical axis: ...", the last one of each kind. Axes are not turned for
/// it: such files come with cameras in the same axes. Other comments mean nothing.
void read_ply_comments(const std::vector<std::string>& comments, SceneContent& content);

} // namespace degs
