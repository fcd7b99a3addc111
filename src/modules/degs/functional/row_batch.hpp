// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/degs/functional/functional_model.hpp"
#include "modules/degs/functional/tile_contexts.hpp"

namespace degs {

/// The outcomes of the rows of up to kSplats neighbouring splats of a tile's list, from a multiple
/// of kSplats on.
struct RowBatch {
    static constexpr std::uint32_t kSplats = 32;
    /// A tile is rasterised up to the batch in which its last pixel ends, and one more, because the
    /// Slicing Units go on until they hear of that end.
    static constexpr int kBatchesAfterEnd = 2;

    struct Splat {
        PixelRange rows;       ///< inside the tile
        std::size_t first = 0; ///< the place of its first row
    };
    std::array<Splat, kSplats> splats;
    std::vector<RowOutcome> outcomes;
    std::uint32_t takes = 0; ///< calls of take() that are still to come, see FunctionalModel

    std::size_t bytes() const { return sizeof(RowBatch) + outcomes.size() * sizeof(RowOutcome); }
    static std::size_t batches_of(const JobTile& tile) {
        return (tile.count + kSplats - 1) / kSplats;
    }
    /// The number of splats in batch `index` of a tile.
    static std::uint32_t splats_of(const JobTile& tile, std::uint32_t index);

    /// Rasterises batch `index` of a tile in its context, after all batches before it. The object
    /// must be empty.
    void rasterise(RenderJob& job, const JobTile& tile, std::uint32_t index,
                   const FunctionalOptions& options, TileContexts& contexts, int context);
    /// The number of pixels that end with these splats.
    std::int64_t ended_pixels() const;
    /// Copies the rows own.first, own.first + step, ... own.last of a splat.
    void copy(std::uint32_t place, const PixelRange& own, int step, RowOutcome* to) const {
        const Splat& splat = splats[place % kSplats];
        for (int row = own.first; row <= own.last; row += step, ++to) {
            *to = outcomes[splat.first + (row - splat.rows.first)];
        }
    }
};

} // namespace degs
