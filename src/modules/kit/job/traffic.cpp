// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/job/traffic.hpp"

#include <algorithm>

#include "degs/error.hpp"
#include "tlm/ceil_div.hpp"

namespace degs {

void TrafficConfig::describe(ConfigVisitor& visitor) {
    visitor.integer("geometry_bytes", geometry_bytes, 0, 1024,
                    "bytes per Gaussian read by projection; 0: as the formats of pipeline.records "
                    "need");
    visitor.integer("sh_value_bytes", sh_value_bytes, 0, 8,
                    "bytes per SH value; 0: as the formats need");
    visitor.choice("sh", sh, {"visible", "all"},
                   "whose SH coefficients are read; all: with the geometry, before culling");
    visitor.integer("splat_bytes", splat_bytes, 1, 1024, "bytes per projected splat record");
    visitor.integer("list_entry_bytes", list_entry_bytes, 1, 64,
                    "bytes per tile-list entry: depth key and index");
    visitor.integer("pixel_bytes", pixel_bytes, 4, 8,
                    "bytes per frame-buffer pixel; 4 is RGBA8, 8 is RGBA16F");
    visitor.integer("burst_bytes", burst_bytes, 1, 4096,
                    "bytes; scattered records are read in whole bursts of this size");
}

void TrafficConfig::set_formats(const ProjectionNumbers& stored) {
    mean_bits_ = stored.mean_bits();
    shape_bits_ = stored.shape_bits();
    sh_dc_bits_ = stored.sh_bits(0);
    sh_rest_bits_ = (stored.sh_bits(1) - sh_dc_bits_) / 3; // of the three channels of a coefficient
}

int TrafficConfig::geometry_size() const {
    return geometry_bytes != 0 ? geometry_bytes : mean_size() + shape_size() + bound_bytes;
}

int TrafficConfig::mean_size() const {
    return mean_bytes != 0 ? mean_bytes : ceil_div(mean_bits_, 8);
}

int TrafficConfig::shape_size() const {
    return shape_bytes != 0 ? shape_bytes : ceil_div(shape_bits_, 8);
}

int TrafficConfig::sh_size(int degree) const {
    const int coefficients = (degree + 1) * (degree + 1);
    return sh_value_bytes != 0 ? 3 * coefficients * sh_value_bytes
                               : ceil_div(sh_dc_bits_ + (coefficients - 1) * sh_rest_bits_, 8);
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
    : geometry(bases.geometry), sh(bases.sh), splats(bases.workspace + bases.ahead),
      frame_buffer(bases.frame_buffer) {
    require_indices(traffic, frame);
    if (!bases.given) {
        sh = geometry + aligned(times(frame.gaussians, traffic.geometry_size()));
        splats = sh + aligned(times(frame.gaussians, traffic.sh_size(frame.sh_degree)));
        frame_buffer = splats + workspace_bytes(traffic, frame);
    }
    lists = splats + aligned(times(frame.gaussians, traffic.splat_bytes));
    list_heads = lists + aligned(times(frame.tile_pairs(), traffic.list_entry_bytes));
}

void MemoryMap::move_behind(const TrafficConfig& traffic, const FrameWorkload& view) {
    const std::uint64_t bytes =
        workspace_bytes(traffic, view) + aligned(times(view.camera.pixels(), traffic.pixel_bytes));
    for (std::uint64_t* const region : {&splats, &lists, &list_heads, &frame_buffer}) {
        *region += bytes;
    }
}

std::uint64_t MemoryMap::workspace_bytes(const TrafficConfig& traffic, const FrameWorkload& frame) {
    // Behind the lists is room for a second copy of them (the groups of GCC), or for their heads.
    const std::uint64_t lists = times(frame.tile_pairs(), traffic.list_entry_bytes);
    return aligned(times(frame.gaussians, traffic.splat_bytes)) + aligned(lists) +
           aligned(std::max(lists, times(frame.tiles(), kListHeadBytes)));
}

} // namespace degs
