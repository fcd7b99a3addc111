// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/frame/projection.hpp"

namespace degs {

/// How an image is cut into square tiles; the last column and row may be partial.
struct TileGrid {
    int width = 0, height = 0; ///< px
    int tile_size = 1;         ///< px
    int tiles_x() const { return (width + tile_size - 1) / tile_size; }
    int tiles_y() const { return (height + tile_size - 1) / tile_size; }
};

/// Tiles first .. last (inclusive) of one row of tiles.
struct TileRun {
    int row = 0, first = 0, last = 0;
};

/// The tiles that hold at least one pixel of the ellipse q <= Q_th (closed, widened by
/// `pixel_slack`), each exactly once, as runs; `runs` is overwritten. Every integer row is solved
/// exactly, so a diagonal needle lists its own tiles and not its bounding box.
void cover_ellipse(const ProjectedSplat& splat, const TileGrid& grid, std::vector<TileRun>& runs);

/// The tiles of the original rasteriser: a square of half width ceil(3
/// sqrt(lambda_max)), in double. Its upper ends are one pixel short and its lower ends
/// up to one pixel generous, as there.
void cover_square(const ProjectedSplat& splat, const TileGrid& grid, std::vector<TileRun>& runs);

} // namespace degs
