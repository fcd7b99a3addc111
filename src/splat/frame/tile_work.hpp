// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace degs {

/// Sizes of a tile, or of several together, on which the time of its rendering depends. Tiles,
/// pixels and entries are exact; the others come from the rows and pixels that were sampled.
struct TileWork {
    double tiles = 1;
    double pixels = 0;    ///< inside the image
    double entries = 0;   ///< length of the lists
    double walked = 0;    ///< entries before all sampled pixels of a tile had ended
    double rows = 0;      ///< rows of splats that reach a row with a pixel that has not ended
    double tasks = 0;     ///< pixels of these rows in the spans, whether or not they have ended
    double fragments = 0; ///< of them those that are blended
    double cycles = 0;    ///< as the analytic model of a design says; 0 without one

    static constexpr std::size_t kSizes = 8;
    std::array<double, kSizes> sizes() const {
        return {tiles, pixels, entries, walked, rows, tasks, fragments, cycles};
    }
    TileWork& operator+=(const TileWork& other) {
        tiles += other.tiles;
        pixels += other.pixels;
        entries += other.entries;
        walked += other.walked;
        rows += other.rows;
        tasks += other.tasks;
        fragments += other.fragments;
        cycles += other.cycles;
        return *this;
    }
};

/// Sizes of nothing.
inline constexpr TileWork kNoWork{0, 0, 0, 0, 0, 0, 0, 0};

} // namespace degs
