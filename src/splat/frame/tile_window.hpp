// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "splat/frame/frame_workload.hpp"

namespace degs {

/// Tiles x0 .. x1 of the rows of tiles y0 .. y1 (inclusive) of a frame: the part of it to render.
struct TileWindow {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
};

inline TileWindow all_tiles(const FrameWorkload& work) {
    return {0, 0, work.tiles_x - 1, work.tiles_y - 1};
}

/// The tiles that hold the pixels of a box, which lies inside the image.
inline TileWindow tiles_around(const FrameWorkload& work, const PixelBox& box) {
    const int size = work.tile_size;
    return {box.x0 / size, box.y0 / size, box.x1 / size, box.y1 / size};
}

/// The pixels of the tiles; the last column and row of tiles end with the image.
inline PixelBox pixels_of(const FrameWorkload& work, const TileWindow& window) {
    const int size = work.tile_size;
    return {window.x0 * size, window.y0 * size,
            std::min((window.x1 + 1) * size, work.camera.width) - 1,
            std::min((window.y1 + 1) * size, work.camera.height) - 1};
}

} // namespace degs
