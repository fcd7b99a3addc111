// SPDX-License-Identifier: Apache-2.0
#include "baselines/gbu/config.hpp"

namespace degs::gbu {

Config::Config() {
    name = "gbu-64";
    projection.latency_cycles = 128;
    pixel_buffer.bytes = 32 * 1024;
    pixel_buffer.state_bytes = 8;
}

void Config::ListBuffer::describe(ConfigVisitor& visitor) {
    visitor.integer(
        "bytes", bytes, 16, 1 << 30,
        "bytes for lists being sorted: what the other buffers leave of Table I's 91 KB [assumed]");
    visitor.integer("chunks", chunks, 1, 1024,
                    "chunks of splat records in front of each engine [assumed]");
}

void Config::Engines::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 256,
                    "tile engines, each on a tile of its own: PEs / rows of a tile [assumed]");
    TileEngine::Config::describe(visitor);
    visitor.integer("entry_bytes", entry_bytes, 1, 64,
                    "bytes per row entry, counted as SRAM [assumed]");
}

void Config::Cache::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 0, 1 << 30,
                    "bytes of splat records kept between tiles, all engines together (GBU: 32 KB); "
                    "0: none");
}

TileCoupling Config::tile_coupling(bool array_only) const {
    if (reuse_cache.bytes == 0 || array_only) {
        return {};
    }
    return {"The reuse cache of this design keeps records between neighbouring tiles, of which a "
            "sample has few",
            "reuse_cache.bytes=0"};
}

void Config::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.integer("tile_size", tile_size, 4, 1024,
                    "px; grows with the PEs like the tiles of DeGS [assumed]");
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    pipeline.describe_records(visitor, traffic);
    visitor.section("projection", projection, "GSCore's culling and conversion units");
    visitor.section("binning", binning, "tile lists");
    visitor.section("sorting", sorting, "GSCore's hierarchical sorting units");
    visitor.section("list_buffer", list_buffer,
                    "lists being sorted and splats in front of engines");
    visitor.section("fetching", fetching, "Splat Fetchers, one per engine");
    visitor.section("reuse_cache", reuse_cache, "splat records kept between tiles");
    visitor.section("engines", engines, "row-centric tile engines");
    visitor.section("pixel_buffer", pixel_buffer, "tiles in flight");
    visitor.section("monitor", monitor, "cancellation of finished tiles");
    visitor.section("memory", memory, "off-chip memory");
    describe_cost(visitor);
    require_sizes(visitor);
}

void Config::require_sizes(ConfigVisitor& visitor) const {
    visitor.require(engines.row_pes <= tile_size, {"engines.row_pes",
                                                   "must not be above tile_size",
                                                   std::to_string(tile_size),
                                                   {"tile_size"}});
    pixel_buffer.require_tiles(visitor, "pixel_buffer", tile_pixels(), engines.count,
                               {"tile_size", "engines.count"});
    visitor.require_at_least("list_buffer.bytes", list_buffer.bytes,
                             std::int64_t{sorting.chunk} * traffic.list_entry_bytes * sorting.count,
                             "to hold a chunk of list entries for every sorting unit",
                             {"sorting.chunk", "sorting.count", "traffic.list_entry_bytes"});
    const std::int64_t records = std::int64_t{engines.count} * traffic.splat_bytes;
    visitor.require(reuse_cache.bytes == 0 || reuse_cache.bytes >= records,
                    {"reuse_cache.bytes",
                     "must be 0 or hold a splat record for every engine",
                     std::to_string(records),
                     {"engines.count", "traffic.splat_bytes"}});
}

} // namespace degs::gbu
