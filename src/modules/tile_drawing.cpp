// SPDX-License-Identifier: Apache-2.0
#include "modules/tile_drawing.hpp"

#include <algorithm>

namespace degs {

void TileDrawing::draw(TileNumber number, std::uint32_t splat, const PixelRange& range, int step,
                       DrawnRow* rows) {
    const JobTile& tile = job_.tiles[number];
    TileRows wanted;
    wanted.splat = splat;
    wanted.context = canvas(number);
    wanted.x_begin = tile.x;
    wanted.x_end = tile.x + tile.width;
    wanted.tile_y = tile.y;
    wanted.first = range.first;
    wanted.last = range.last;
    wanted.step = step;
    wanted.tests = tests_;
    job_.path->draw_rows(wanted, rows);
    for (int row = range.first; row <= range.last; row += step, ++rows) {
        fragments_ += __builtin_popcountll(rows->useful);
    }
}

int TileDrawing::canvas(TileNumber number) {
    return number < canvases_.size() && canvases_[number] != kNone ? canvases_[number]
                                                                   : open(number);
}

int TileDrawing::open(TileNumber number) {
    if (number >= canvases_.size()) {
        canvases_.resize(std::max<std::size_t>(job_.tiles.size(), number + 1), kNone);
    }
    if (free_.empty()) {
        free_.push_back(static_cast<int>(cleared_.size()));
        cleared_.push_back(0);
        job_.path->hold_contexts(static_cast<int>(cleared_.size()));
    }
    canvases_[number] = free_.back();
    free_.pop_back();
    return canvases_[number];
}

void TileDrawing::clear_row(TileNumber number, int row) {
    const int place = canvas(number);
    job_.path->begin_row(place, row);
    if (++cleared_[place] == job_.tile_size) {
        cleared_[place] = 0;
        canvases_[number] = kNone;
        free_.push_back(place);
    }
}

} // namespace degs
