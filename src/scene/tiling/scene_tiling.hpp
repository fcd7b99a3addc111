// SPDX-License-Identifier: Apache-2.0
// Large scenes from one: copies side by side.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/gltf/gltf.hpp"

namespace degs {

/// Copies along x, y and z; the world is that of PLY, with -y up.
struct TilingCounts {
    int x = 1, y = 1, z = 1;
    std::uint64_t copies = 1; ///< at most x * y * z; the last rows stay empty

    static constexpr std::uint64_t kMostCopies = 16384;
};

/// "NxM" (along x and z) or "NxMxK" (and K layers). InputError for other texts and for more than
/// kMostCopies.
TilingCounts parse_tiling(const std::string& text);

/// The fewest copies, in a square grid of one layer, that make at least `wanted` Gaussians of
/// `gaussians` (at least 1). InputError if that takes more than kMostCopies.
TilingCounts tiling_for(std::uint64_t wanted, std::uint64_t gaussians);

struct SceneTiling {
    std::vector<GlbInstance> instances;
    std::vector<Camera> cameras; ///< overview, near, closeup; 1920 x 1080
    glm::dvec3 spacing{0.0};     ///< scene units between neighbours
};

/// Places copies of a cloud (not empty) around the original. What lies between the 1st and the 99th
/// percentile of the means counts as its extent; neighbours are 1.05 times the larger horizontal
/// extent apart, layers 1.05 times the vertical one. Each copy is turned about the vertical axis
/// through the middle by 0, 90, 180 or 270 degrees, other than its neighbours. The overview sees
/// the whole grid; `near` looks across it from its edge, and `closeup` from a corner inside.
SceneTiling tile_scene(const GaussianCloud& cloud, const TilingCounts& counts);

} // namespace degs
