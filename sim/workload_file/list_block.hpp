// SPDX-License-Identifier: Apache-2.0
// Tile lists as the blocks of bytes that a workload file holds; docs/workload.md has their form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/workload_file/byte_planes.hpp"
#include "splat/frame/frame_workload.hpp"

namespace degs::sim {

/// A length per tile, or a step per entry of a list.
constexpr std::size_t kBytesPerEntry = 4;

/// The lengths of the lists of all tiles.
std::string pack_lengths(const FrameWorkload& frame);

/// Sets tile_begin from such a block; throws InputError unless every list has at most `splats`
/// entries and all together have `entries`.
void unpack_lengths(const std::string& path, const std::string& place, std::string_view block,
                    std::uint64_t splats, std::uint64_t entries,
                    std::vector<std::uint64_t>& tile_begin);

/// The tiles at which blocks of lists begin, and the one behind the last block. A block ends with
/// the tile that gives it 32 768 entries; without entries there is none.
std::vector<std::size_t> list_cuts(const std::vector<std::uint64_t>& tile_begin);

/// The lists of tiles first .. end - 1.
std::string pack_lists(const FrameWorkload& frame, std::size_t first, std::size_t end);

/// Fills in these lists, for which the frame has room, and counts the entries of every splat in
/// `touched`. Throws InputError for a splat that is not there; that splats rise follows from the
/// form.
void unpack_lists(const std::string& path, const std::string& place, std::string_view block,
                  std::size_t first, std::size_t end, PlaneReader::Workspace& workspace,
                  FrameWorkload& frame, std::vector<std::uint32_t>& touched);

} // namespace degs::sim
