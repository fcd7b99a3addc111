// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/kit/job/messages.hpp"

namespace degs::orange {

/// Splats of one tile that pass through a core together: coefficients on their way to the systolic
/// array, then a product on its way back.
struct GemmBatch {
    TileNumber tile = 0;     ///< kNoTile: nothing follows
    std::uint64_t first = 0; ///< index into FrameWorkload::tile_splats
    std::uint32_t splats = 0;
    bool last = false; ///< of its tile
    // Filled by the array.
    Cycle begin = 0, end = 0; ///< it worked on the product in [begin, end)
    Cycle idle_from = 0;      ///< since when it had nothing to do
    Cycle blocked = 0;        ///< cycles before `begin` without room for the product
};

} // namespace degs::orange
