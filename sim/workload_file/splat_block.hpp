// SPDX-License-Identifier: Apache-2.0
// Splats as the blocks of bytes that a workload file holds; docs/workload.md has their form.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "splat/frame/frame_workload.hpp"

namespace degs::sim {

constexpr std::size_t kSplatsPerBlock = 1U << 14U;
/// A number, three coordinates in single precision, and 13 values in double precision.
constexpr std::size_t kBytesPerSplat = 4 + 3 * 4 + 13 * 8;
/// No block becomes more than this number of times as long when it is unpacked.
constexpr std::size_t kMostInflation = 1024;

/// How many blocks that number of splats fills.
std::size_t blocks_of(std::size_t splats);

/// The bytes of splats begin .. end - 1: columns of values, each as planes of bytes, compressed. A
/// block that is as long as its values is not compressed.
std::string pack_splats(const ReadySplats& splats, std::size_t begin, std::size_t end);

/// Fills in splats begin .. end - 1, whose places are there. Throws InputError, which names the
/// file `path` and the block by `place`, for a damaged block, for values that no projection gives
/// and for numbers of Gaussians that do not rise within the block.
void unpack_splats(const std::string& path, const std::string& place, std::string_view packed,
                   std::size_t begin, std::size_t end, ReadySplats& splats);

} // namespace degs::sim
