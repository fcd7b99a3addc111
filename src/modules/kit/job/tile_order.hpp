// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/frame/frame_workload.hpp"

namespace degs {

/// The order in which the tiles of a frame go through sorting and rasterisation. `Raster`: row by
/// row of the image. `LongestList`: by falling length of their lists, equal lengths in raster
/// order, so that what is in work when a frame ends is short. When the lists of a frame are
/// complete, the Tile Binner knows all lengths; a counting sort of the tile numbers by them takes
/// no time and no area here [assumed].
enum class TileOrder { Raster, LongestList };

/// The tiles of the frame that list a splat, by their place in the image row by row, in the order
/// in which they are taken.
std::vector<int> listed_tiles(const FrameWorkload& frame, TileOrder order);

} // namespace degs
