// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/degs/functional/functional_model.hpp"
#include "modules/degs/functional/tile_contexts.hpp"

namespace degs {

/// The drawn rows of some neighbouring splats of a tile's list, from a multiple of kSplats on.
struct RowBatch {
    static constexpr std::uint32_t kSplats = 32;
    /// A tile is drawn up to the batch in which its last pixel ends, and one more, because its
    /// slicing goes on until it hears of that.
    static constexpr int kBatchesAfterEnd = 2;

    struct Splat {
        PixelRange rows;       ///< inside the tile
        std::size_t first = 0; ///< the place of its first row
    };
    std::array<Splat, kSplats> splats;
    std::vector<RowOutcome> outcomes;
    std::uint32_t takes = 0; ///< by the simulation, that are left

    std::size_t bytes() const { return sizeof(RowBatch) + outcomes.size() * sizeof(RowOutcome); }
    static std::size_t batches_of(const JobTile& tile) {
        return (tile.count + kSplats - 1) / kSplats;
    }
    /// Splats of batch `index` of a tile.
    static std::uint32_t splats_of(const JobTile& tile, std::uint32_t index);

    /// Draws batch `index` of a tile on its context, after all before it. The batch is empty.
    void rasterise(RenderJob& job, const JobTile& tile, std::uint32_t index,
                   const FunctionalOptions& options, TileContexts& contexts, int context);
    /// Pixels that end with its splats.
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
