// SPDX-License-Identifier: Apache-2.0
#include "baselines/gscore/config.hpp"

#include <algorithm>

#include "tlm/ceil_div.hpp"

namespace degs::gscore {

void Config::Buffer::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 256, 1 << 30,
                    "bytes in all, pixel_buffer.bytes included (paper Table I: 8 x 34 KB)");
    visitor.real("sort_share", sort_share, 0.05, 0.95,
                 "share of what the Pixel Buffer leaves for lists being sorted [assumed]");
}

Config::Config() {
    name = "gscore-64";
    projection.latency_cycles = 128;
    pixel_buffer.bytes = 8 * 1024; // two tiles of 16 x 16 px
}

void Config::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.integer(
        "clusters", clusters, 1, 64,
        "arrays, each with the buffers below and on a tile of its own, behind one front "
        "end; beyond the paper");
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    pipeline.describe_records(visitor, traffic);
    visitor.section("projection", projection, "culling and conversion units");
    visitor.section("binning", binning, "tile lists");
    visitor.section("sorting", sorting, "hierarchical sorting units");
    visitor.section("fetching", fetching, "Splat Fetchers, one per sorting unit");
    visitor.section("buffer", buffer, "on-chip memory");
    visitor.section("array", array, "volume rendering cores");
    visitor.section("pixel_buffer", pixel_buffer, "tiles in flight, part of buffer.bytes");
    visitor.section("monitor", monitor, "cancellation of finished tiles");
    visitor.section("memory", memory, "off-chip memory");
    describe_cost(visitor);
    require_sizes(visitor);
}

void Config::require_sizes(ConfigVisitor& visitor) const {
    pixel_buffer.require_tiles(visitor, "pixel_buffer", tile_pixels(), 1,
                               {"array.lanes", "clusters"}, kMostContexts / clusters);
    const int lists = ceil_div(sorting.chunk * traffic.list_entry_bytes, clusters);
    visitor.require_at_least(
        "buffer.bytes", buffer.bytes,
        pixel_buffer.bytes +
            std::max(splat_share().least_buffer(chunk_bytes()), sort_share().least_buffer(lists)),
        "to hold the tiles, and a chunk of splats and one of list entries for every sorting unit",
        {"pixel_buffer.bytes", "buffer.sort_share", "sorting.count", "fetching.chunk",
         "sorting.chunk", "clusters"});
}

} // namespace degs::gscore
