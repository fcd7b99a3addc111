// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "config/config.hpp"
#include "splat/frame/frame_workload.hpp"

namespace degs {

/// The Gaussians whose SH coefficients are read: the visible ones, or all.
enum class ShReads { Visible, All };

/// Record layouts of the streams between accelerator and memory [assumed]; see docs/memory.md.
struct TrafficConfig {
    int geometry_bytes = 22; ///< per Gaussian: 11 values of 2 B
    int sh_value_bytes = 2;  ///< per coefficient and channel
    ShReads sh = ShReads::Visible;
    int splat_bytes = 32;     ///< per projected splat
    int list_entry_bytes = 8; ///< per tile pair: depth key 4, index 4
    int pixel_bytes = 4;      ///< per frame-buffer pixel, RGBA8
    int burst_bytes = 64;     ///< gathers are rounded up to this
    void describe(ConfigVisitor& visitor);

    std::uint64_t sh_bytes(int degree) const {
        return 3 * (degree + 1) * (degree + 1) * sh_value_bytes;
    }
};

/// A scene of single-precision values: mean 3, scale 3, rotation 4, opacity 1, and the SH apart.
constexpr int kFloatBytes = 4;
constexpr int kFloatGeometryBytes = 11 * kFloatBytes;

/// The addresses that a platform gives to the streams of a frame. Without bases the regions follow
/// each other from address 0.
struct MemoryBases {
    bool given = false;
    std::uint64_t geometry = 0, sh = 0;
    std::uint64_t workspace = 0; ///< splat records and lists
    std::uint64_t frame_buffer = 0;
    int pixel_bytes = 0; ///< of this frame; 0: as TrafficConfig says
};

/// The addresses of the streams in memory; regions are aligned to 4 KiB.
struct MemoryMap {
    std::uint64_t geometry = 0, sh = 0, splats = 0, lists = 0, frame_buffer = 0;
    MemoryMap() = default;
    MemoryMap(const TrafficConfig& traffic, const FrameWorkload& frame,
              const MemoryBases& bases = {});
    /// Bytes from the first splat record to the end of the lists.
    static std::uint64_t workspace_bytes(const TrafficConfig& traffic, const FrameWorkload& frame);
};

} // namespace degs
