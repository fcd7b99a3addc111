// SPDX-License-Identifier: Apache-2.0
// What the tiles of a frame ask for, from a sample of their pixel rows.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "splat/frame_workload.hpp"

namespace degs {

/// Sizes of a tile, or of several together, on which the time of its rendering depends. Tiles,
/// pixels and entries are exact; the others are scaled up from the sampled rows.
struct TileWork {
    double tiles = 1;
    double pixels = 0;  ///< inside the image
    double entries = 0; ///< length of the lists
    double walked = 0;  ///< entries before all sampled pixels of a tile had ended
    double rows = 0;    ///< rows of splats that reach a row with a pixel that has not ended
    double tasks = 0;   ///< pixels of these rows inside the ellipse, whether or not they have ended
    double fragments = 0; ///< of them those that are blended

    static constexpr std::size_t kSizes = 7;
    std::array<double, kSizes> sizes() const {
        return {tiles, pixels, entries, walked, rows, tasks, fragments};
    }
    TileWork& operator+=(const TileWork& other);
};

/// Sizes of nothing.
inline constexpr TileWork kNoWork{0, 0, 0, 0, 0, 0, 0};

/// The work of every tile of the frame, row by row; tiles that list no splat have 0 entries. One
/// pixel row in `rows_apart` (at least 1) is rendered, in single precision and by the rules of the
/// reference renderer, at a height that differs from tile to tile; a tile of fewer rows has one. With
/// 1, `fragments` are those of the reference up to rounding.
std::vector<TileWork> estimate_tile_work(const FrameWorkload& frame, int rows_apart = 16);

} // namespace degs
