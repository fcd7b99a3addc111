// SPDX-License-Identifier: Apache-2.0
// The kinds of records that several accelerators read and write; docs/memory.md has their sizes.
#pragma once

#include "modules/kit/memory/main_memory.hpp"

namespace degs::stream_kinds {

inline constexpr StreamKind kGeometry{
    "geometry", StreamData::Scene,
    "Position, scale, rotation and opacity of every Gaussian, read by projection.", true};
inline constexpr StreamKind kSh{
    "sh", StreamData::Scene,
    "Coefficients of the spherical harmonics, read in whole bursts for the colour.", true};
inline constexpr StreamKind kSplatsWritten{"splats_written", StreamData::Own,
                                           "Records of the visible splats, written once.", true};
inline constexpr StreamKind kTileListsWritten{
    "tile_lists_written", StreamData::Own,
    "Entries of the tile lists, written when splats are assigned to tiles.", true};
inline constexpr StreamKind kListHeads{
    "list_heads", StreamData::Own,
    "Words that say where the lists of tiles end, read and written for every group of entries; "
    "only those that do not fit the chip.",
    true};
inline constexpr StreamKind kTileListsSorted{
    "tile_lists_sorted", StreamData::Own,
    "Entries of the tile lists, read by sorting; written and read again for every further pass."};
inline constexpr StreamKind kSplatsRead{
    "splats_read", StreamData::Own,
    "Splat records, read in whole bursts for every tile that lists them."};
inline constexpr StreamKind kFrameBuffer{"frame_buffer", StreamData::Own,
                                         "Finished pixels and background, written."};

} // namespace degs::stream_kinds
