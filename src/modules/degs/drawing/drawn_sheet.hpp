// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/degs/drawing/tile_canvases.hpp"
#include "modules/degs/drawing/tile_drawing.hpp"

namespace degs {

/// The drawn rows of some neighbouring splats of a tile's list, from a multiple of kSplats on.
struct DrawnSheet {
    static constexpr std::uint32_t kSplats = 32;
    /// A tile is drawn up to the sheet in which its last pixel ends, and one more, because its
    /// slicing goes on until it hears of that.
    static constexpr int kSheetsAfterEnd = 2;

    struct Splat {
        PixelRange rows;       ///< inside the tile
        std::size_t drawn = 0; ///< the place of its first row
    };
    std::array<Splat, kSplats> splats;
    std::vector<DrawnRow> drawn;
    std::uint32_t takes = 0; ///< by the simulation, that are left

    std::size_t bytes() const { return sizeof(DrawnSheet) + drawn.size() * sizeof(DrawnRow); }
    static std::size_t sheets_of(const JobTile& tile) {
        return (tile.count + kSplats - 1) / kSplats;
    }
    /// Splats of sheet `index` of a tile.
    static std::uint32_t splats_of(const JobTile& tile, std::uint32_t index);

    /// Draws sheet `index` of a tile on its canvas, after all before it. The sheet is empty.
    void draw(RenderJob& job, const JobTile& tile, std::uint32_t index,
              const DrawingOptions& options, TileCanvases& canvases, int canvas);
    /// Pixels that end with its splats.
    std::int64_t ended_pixels() const;
    /// Copies the rows own.first, own.first + step, ... own.last of a splat.
    void copy(std::uint32_t place, const PixelRange& own, int step, DrawnRow* to) const {
        const Splat& splat = splats[place % kSplats];
        for (int row = own.first; row <= own.last; row += step, ++to) {
            *to = drawn[splat.drawn + (row - splat.rows.first)];
        }
    }
};

} // namespace degs
