// SPDX-License-Identifier: Apache-2.0
// What the projected frame of a view depends on beside the view: designs of the same kind share it.
#pragma once

#include <string>
#include <tuple>
#include <utility>

#include "modules/kit/accelerator/render_engine.hpp"
#include "scene/scene.hpp"
#include "splat/frame/frame_workload.hpp"

namespace degs::sim {

/// The rules that a projection and its reference are drawn by.
using RuleKind = std::tuple<SplatOrder, bool, double, double, double, ProjectionRule, LensRule,
                            double, double, double>;
RuleKind rule_kind(const ProjectionOptions& options);

/// Side and mode of the tiles of a frame as far as its image depends on them: 0 and Exact where
/// lists are of whole ellipses and no tile is hidden.
std::pair<int, TileMode> image_tiles(const FrameWorkload& frame);

/// The rules, the formats of the projection (empty for those of the reference, whose frames the
/// reference's and come first), the side of a tile and the tile mode.
using FrameKind = std::tuple<RuleKind, std::string, int, TileMode>;
FrameKind frame_kind(const AcceleratorConfig& config, const SceneTraits& traits);

} // namespace degs::sim
