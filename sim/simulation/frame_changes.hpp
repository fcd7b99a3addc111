// SPDX-License-Identifier: Apache-2.0
// How much the work differs from frame to frame, and how uneven it is; docs/dynamic-scenes.md has
// the formulas.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "splat/frame/frame_workload.hpp"

namespace degs::sim {

struct FrameChanges {
    std::size_t frames = 0;
    std::optional<double> active_overlap; ///< 0..1; empty if the frames have different Gaussians
    std::optional<double> tile_churn;     ///< 0..1; empty if the frames have different tiles
    double p99_tile_candidates = 0;       ///< splats in a tile's list
    double footprint_gini = 0;            ///< 0..1
};

/// The changes from frame to frame; at least one frame. A single frame has no overlap and no churn.
FrameChanges frame_changes(const std::vector<const FrameWorkload*>& frames);

/// "active overlap 0.987 · tile churn 4.6 % · P99 of tile candidates 1.2 k · footprint Gini 0.85";
/// what is missing is left out.
std::string changes_words(const FrameChanges& changes);

} // namespace degs::sim
