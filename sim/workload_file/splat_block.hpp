// SPDX-License-Identifier: Apache-2.0
// Gaussians and splats as the blocks of bytes that a workload file holds; docs/workload.md has
// their form.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "sim/view/frame_checks.hpp"
#include "sim/workload_file/byte_planes.hpp"
#include "splat/frame/frame_workload.hpp"
#include "splat/numbers/number_format.hpp"

namespace degs::sim {

constexpr std::size_t kSplatsPerBlock = 1U << 14U;
/// A number and three coordinates in single precision.
constexpr std::size_t kBytesPerGaussian = 4 + 3 * 4;
/// A place, and 13 values of which each has 4 bytes at least.
constexpr std::size_t kBytesPerSplat = 4 + 13 * 4;

/// How many blocks that number of splats fills.
std::size_t blocks_of(std::size_t splats);

/// Numbers and means of the visible Gaussians begin .. end - 1, in the order of the cloud.
std::string pack_gaussians(const FrameWorkload& frame, std::size_t begin, std::size_t end);

/// Splats begin .. end - 1, near to far, with the places of their Gaussians among the visible ones.
std::string pack_splats(const FrameWorkload& frame, std::size_t begin, std::size_t end);

/// Unpacks the blocks of one file into the frame, which has room for them. Mistakes are InputErrors
/// that name the file and the block by `place`.
class SplatUnpacker {
public:
    SplatUnpacker(const std::string& path, FrameWorkload& frame);

    /// Refuses means that are not finite, and numbers that do not rise within the block.
    void gaussians(const std::string& place, std::string_view block, std::size_t begin,
                   std::size_t end, PlaneReader::Workspace& workspace) const;
    /// The visible Gaussians of the frame are known. Refuses values that no projection gives and
    /// splats that are not in the order of their depths within the block.
    void splats(const std::string& place, std::string_view block, std::size_t begin,
                std::size_t end, PlaneReader::Workspace& workspace) const;
    /// Refuses what does not fit between blocks: numbers that do not rise, depths that fall, and
    /// Gaussians without a splat, because others then have two.
    void check_whole(const std::string& place) const;

private:
    void check_gaussian(const std::string& place, std::size_t at, bool has_before) const;
    float depth_key(std::size_t at) const;
    void check_order(const std::string& place, std::size_t at, float before, float own) const;

    const std::string& path_;
    FrameWorkload& frame_;
    SplatLimits limits_;
    Rounder key_of_;                                     ///< what splats are ordered by
    std::unique_ptr<std::atomic<unsigned char>[]> seen_; ///< per Gaussian: whether it has a splat
};

} // namespace degs::sim
