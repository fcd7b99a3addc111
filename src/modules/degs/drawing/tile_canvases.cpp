// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/drawing/tile_canvases.hpp"

#include <algorithm>

namespace degs {

int TileCanvases::open() {
    if (free_.empty()) {
        free_.push_back(canvases_++);
        job_.path->hold_contexts(canvases_);
    }
    const int canvas = free_.back();
    free_.pop_back();
    return canvas;
}

void TileCanvases::draw(int canvas, const JobTile& tile, std::uint32_t splat,
                        const PixelRange& range, int step, DrawnRow* rows) {
    TileRows wanted;
    wanted.splat = splat;
    wanted.context = canvas;
    wanted.x_begin = tile.x;
    wanted.x_end = tile.x + tile.width;
    wanted.tile_y = tile.y;
    wanted.drawn = tile.drawn_columns();
    wanted.step = step;
    wanted.tests = tests_;
    for (int first = range.first; first <= range.last; first += kMostDrawnRows * step) {
        wanted.first = first;
        wanted.last = std::min(range.last, first + (kMostDrawnRows - 1) * step);
        job_.path->draw_rows(wanted, rows);
        rows += kMostDrawnRows;
    }
}

} // namespace degs
