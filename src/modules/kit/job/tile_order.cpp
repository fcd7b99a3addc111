// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/job/tile_order.hpp"

#include <algorithm>
#include <cstdint>

namespace degs {

std::vector<int> listed_tiles(const FrameWorkload& frame, TileOrder order) {
    const auto entries = [&frame](int tile) -> std::uint64_t {
        return frame.tile_begin[tile + 1] - frame.tile_begin[tile];
    };
    std::vector<int> tiles;
    for (int tile = 0; tile < frame.tiles(); ++tile) {
        if (entries(tile) != 0) {
            tiles.push_back(tile);
        }
    }
    if (order == TileOrder::LongestList) {
        std::stable_sort(tiles.begin(), tiles.end(),
                         [&](int a, int b) { return entries(a) > entries(b); });
    }
    return tiles;
}

} // namespace degs
