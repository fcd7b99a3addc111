// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/frame/projection.hpp"
#include "splat/frame/tile_grid.hpp"

namespace degs {

/// Tiles first .. last (inclusive) of one row of tiles, counted from the image's first tile.
struct TileRun {
    int row = 0, first = 0, last = 0;
};

/// The tiles that hold at least one pixel of the ellipse q <= Q_th (closed, widened by
/// `pixel_slack`), each exactly once, as runs; `runs` is overwritten. Neither cover has hidden
/// tiles. Every integer row is solved exactly, so a diagonal needle lists its own tiles and not its
/// bounding box.
void cover_ellipse(const ProjectedSplat& splat, const TileGrid& grid, std::vector<TileRun>& runs);

/// The tiles of the original rasteriser: a square of half width ceil(3
/// sqrt(lambda_max)), in double. Its upper ends are one pixel short and its lower ends
/// up to one pixel generous, as there.
void cover_square(const ProjectedSplat& splat, const TileGrid& grid, std::vector<TileRun>& runs);

} // namespace degs
