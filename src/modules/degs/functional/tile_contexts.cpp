// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/functional/tile_contexts.hpp"

#include <algorithm>

namespace degs {

int TileContexts::open() {
    if (free_.empty()) {
        free_.push_back(contexts_++);
        job_.path->hold_contexts(contexts_);
    }
    const int context = free_.back();
    free_.pop_back();
    return context;
}

void TileContexts::rasterise(int context, const JobTile& tile, std::uint32_t splat,
                             const PixelRange& range, int step, RowOutcome* outcomes) {
    TileRows wanted;
    wanted.splat = splat;
    wanted.context = context;
    wanted.x_begin = tile.x;
    wanted.x_end = tile.x + tile.width;
    wanted.tile_y = tile.y;
    wanted.image_columns = tile.image_columns();
    wanted.step = step;
    wanted.tests = tests_;
    for (int first = range.first; first <= range.last; first += kMostRowsAtOnce * step) {
        wanted.first = first;
        wanted.last = std::min(range.last, first + (kMostRowsAtOnce - 1) * step);
        job_.path->rasterise_rows(wanted, outcomes);
        outcomes += kMostRowsAtOnce;
    }
}

} // namespace degs
