// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/job/traffic.hpp"

#include "degs/error.hpp"

namespace degs {

void TrafficConfig::describe(ConfigVisitor& visitor) {
    visitor.integer("geometry_bytes", geometry_bytes, 1, 1024,
                    "bytes per Gaussian read by projection; 11 values of FP16 (44 for FP32)");
    visitor.integer("sh_value_bytes", sh_value_bytes, 1, 8,
                    "bytes per SH value; a second array, so that culled Gaussians cost no colour");
    visitor.choice("sh", sh, {"visible", "all"},
                   "whose SH coefficients are read; all: with the geometry, before culling");
    visitor.integer("splat_bytes", splat_bytes, 1, 1024, "bytes per projected splat record");
    visitor.integer("list_entry_bytes", list_entry_bytes, 1, 64,
                    "bytes per tile-list entry; depth key 4 + index 4, as in tile-based designs");
    visitor.integer("pixel_bytes", pixel_bytes, 4, 8,
                    "bytes per frame-buffer pixel; 4 is RGBA8, 8 is RGBA16F");
    visitor.integer("burst_bytes", burst_bytes, 1, 4096,
                    "bytes; scattered records are read in whole bursts of this size");
}

namespace {

std::uint64_t aligned(std::uint64_t bytes) {
    return (bytes + 4095) / 4096 * 4096;
}
std::uint64_t times(std::uint64_t count, int bytes) {
    return count * bytes;
}

/// List entries with a depth key of fewer bits hold an index in the rest; the default entry has 32
/// bits for either.
void require_indices(const TrafficConfig& traffic, const FrameWorkload& frame) {
    const NumberFormat& key = frame.projection.numbers.depth_key;
    const int bits = 8 * traffic.list_entry_bytes - key.storage_bits();
    if (key != ProjectionNumbers().depth_key && bits < 32 &&
        frame.splats.size() > std::uint64_t{1} << bits) {
        throw InputError("A frame has " + std::to_string(frame.splats.size()) +
                         " visible splats, but list entries of " +
                         std::to_string(traffic.list_entry_bytes) + " B with depth keys " +
                         key.name() + " leave " + std::to_string(bits) +
                         " bits for the index; raise traffic.list_entry_bytes.");
    }
}

} // namespace

MemoryMap::MemoryMap(const TrafficConfig& traffic, const FrameWorkload& frame,
                     const MemoryBases& bases)
    : geometry(bases.geometry), sh(bases.sh), splats(bases.workspace),
      frame_buffer(bases.frame_buffer) {
    require_indices(traffic, frame);
    if (!bases.given) {
        sh = geometry + aligned(times(frame.gaussians, traffic.geometry_bytes));
        splats = sh + aligned(frame.gaussians * traffic.sh_bytes(frame.sh_degree));
        frame_buffer = splats + workspace_bytes(traffic, frame);
    }
    lists = splats + aligned(times(frame.gaussians, traffic.splat_bytes));
}

std::uint64_t MemoryMap::workspace_bytes(const TrafficConfig& traffic, const FrameWorkload& frame) {
    return aligned(times(frame.gaussians, traffic.splat_bytes)) +
           2 * aligned(times(frame.tile_pairs(), traffic.list_entry_bytes));
}

} // namespace degs
