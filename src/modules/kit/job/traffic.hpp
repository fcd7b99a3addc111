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
    int geometry_bytes = 0; ///< per Gaussian: mean, scale, rotation, opacity; 0: as formats need
    int sh_value_bytes = 0; ///< per coefficient and channel; 0: as formats need
    ShReads sh = ShReads::Visible;
    int splat_bytes = 32;     ///< per projected splat
    int list_entry_bytes = 8; ///< per tile pair: depth key 4, index 4
    int pixel_bytes = 4;      ///< per frame-buffer pixel, RGBA8
    int burst_bytes = 64;     ///< gathers are rounded up to this
    /// Parts of the geometry, for accelerators that read it in stages and have keys of their own
    /// for it: mean, and scale, rotation and opacity (0: as formats need), and what such a stage
    /// needs beside them.
    int mean_bytes = 0, shape_bytes = 0, bound_bytes = 0;
    void describe(ConfigVisitor& visitor);

    /// The formats from which sizes follow; those of FP16 until it is called.
    void set_formats(const ProjectionNumbers& stored);
    /// Bytes of a Gaussian's geometry, of its parts, and of its SH coefficients: as the keys say,
    /// else whole bytes of the formats.
    int geometry_size() const;
    int mean_size() const;
    int shape_size() const;
    int sh_size(int degree) const;

private:
    int mean_bits_ = 3 * 16, shape_bits_ = 8 * 16, sh_dc_bits_ = 3 * 16, sh_rest_bits_ = 3 * 16;
};

/// Bytes of the word that says where a list ends.
constexpr int kListHeadBytes = 4;

/// A scene of single-precision values: mean 3, scale 3, rotation 4, opacity 1, and the SH apart.
constexpr int kFloatBytes = 4;
constexpr int kFloatGeometryBytes = 11 * kFloatBytes;

/// The addresses that a platform gives to the streams of a frame. Without bases the regions follow
/// each other from address 0.
struct MemoryBases {
    bool given = false;
    std::uint64_t geometry = 0, sh = 0;
    std::uint64_t workspace = 0; ///< splat records and lists
    std::uint64_t ahead = 0;     ///< B of the workspace that other views of the frame have
    std::uint64_t frame_buffer = 0;
    int pixel_bytes = 0; ///< of this frame; 0: as TrafficConfig says
};

/// The addresses of the streams in memory; regions are aligned to 4 KiB.
struct MemoryMap {
    std::uint64_t geometry = 0, sh = 0, splats = 0, lists = 0, frame_buffer = 0;
    std::uint64_t list_heads = 0; ///< a word for each tile: where its list ends
    MemoryMap() = default;
    MemoryMap(const TrafficConfig& traffic, const FrameWorkload& frame,
              const MemoryBases& bases = {});
    /// Moves all but the scene behind what an earlier view has.
    void move_behind(const TrafficConfig& traffic, const FrameWorkload& view);
    /// Bytes from the first splat record to the end of the lists and their heads.
    static std::uint64_t workspace_bytes(const TrafficConfig& traffic, const FrameWorkload& frame);
};

} // namespace degs
