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

/// Which tiles list a splat. The test of a pixel is the same with all of them.
enum class TileMode {
    /// Tiles with a pixel of the ellipse q <= Q_th (closed, widened by `pixel_slack`). Every pixel
    /// row is solved, so a diagonal needle lists its own tiles and not its bounding box.
    Exact,
    /// Tiles of the reference code: a square of half width ceil(3 sqrt(lambda_max)), in double. Its
    /// upper ends are one pixel short and its lower ends up to one pixel generous, as there.
    Square,
    /// Tiles of the axis-aligned 3-sigma box (paper, Sec. II-A) of half widths ceil(3 sqrt(cov_a))
    /// and ceil(3 sqrt(cov_c)), with the ends of the square.
    Box,
    /// Tiles with a pixel of the bounding box of the ellipse, `pixel_box`.
    Tight
};

/// Names of the modes, in this order.
const std::vector<const char*>& tile_mode_names();
/// The description of a key that chooses among them, "name: meaning; ...".
extern const char* const kTileModesDoc;

/// Whether every tile with a pixel of the ellipse is listed, so that images do not depend on lists.
/// The 3-sigma modes lose pixels of splats with an opacity above about 0.35.
constexpr bool lists_whole_ellipse(TileMode mode) {
    return mode == TileMode::Exact || mode == TileMode::Tight;
}

/// The tiles that list the splat, each once and none of them hidden, as runs; `runs` is
/// overwritten.
void cover_tiles(const ProjectedSplat& splat, const TileGrid& grid, TileMode mode,
                 std::vector<TileRun>& runs);

} // namespace degs
