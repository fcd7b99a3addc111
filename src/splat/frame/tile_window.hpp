// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/frame/frame_workload.hpp"

namespace degs {

/// Tiles x0 .. x1 of the rows of tiles y0 .. y1 (inclusive) of a frame, counted from its first one:
/// the part of it to render.
struct TileWindow {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
};

inline TileWindow all_tiles(const FrameWorkload& work) {
    return {0, 0, work.tiles_x - 1, work.tiles_y - 1};
}

/// The tiles that hold the pixels of a box of the raster, which lies inside the image.
inline TileWindow tiles_around(const FrameWorkload& work, const PixelBox& box) {
    const TileGrid grid = work.grid();
    const int size = work.tile_size, column = grid.first_column(), row = grid.first_row();
    return {box.x0 / size - column, box.y0 / size - row, box.x1 / size - column,
            box.y1 / size - row};
}

/// The pixels of the image in these tiles, in the raster.
inline PixelBox pixels_of(const FrameWorkload& work, const TileWindow& window) {
    const TileGrid grid = work.grid();
    const PixelBox first = grid.image_pixels_of(window.y0 * work.tiles_x + window.x0);
    const PixelBox last = grid.image_pixels_of(window.y1 * work.tiles_x + window.x1);
    return {first.x0, first.y0, last.x1, last.y1};
}

} // namespace degs
