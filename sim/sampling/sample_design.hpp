// SPDX-License-Identifier: Apache-2.0
// Which tiles a sampled run simulates, and in which order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "splat/frame/tile_work.hpp"

namespace degs::sim {

/// Consecutive tiles, the unit that is drawn.
struct TileBlock {
    std::size_t first = 0, count = 0; ///< of the tiles that list a splat
};

struct SampleSizes {
    std::size_t edge = 0;  ///< tiles at either end of the frame that are always simulated
    std::size_t block = 1; ///< tiles of a block
    std::size_t group = 1; ///< tiles of a group of blocks
};

/// The tiles between the ends of the frame, cut into blocks, and the blocks dealt to groups. Every
/// group is a stratified random sample of all blocks: they are sorted by expected work and cut into
/// strata of as many blocks as there are groups, and each group gets one block of each stratum.
struct SampleDesign {
    std::size_t edge = 0;
    std::vector<TileBlock> blocks;
    /// Positions in `blocks`, in the order of expected work: a tile whose list takes long to sort
    /// must not follow tiles that leave no time for it, if its neighbours would not.
    std::vector<std::vector<std::size_t>> groups;
};

/// `work`: of the tiles that list a splat, in the order in which they are rendered. The same seed
/// gives the same groups on every machine. There is no group if fewer tiles than both ends remain.
SampleDesign design_sample(const std::vector<TileWork>& work, const SampleSizes& sizes,
                           std::uint64_t seed);

} // namespace degs::sim
