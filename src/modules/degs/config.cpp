// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/config.hpp"

#include <algorithm>

#include "tlm/ceil_div.hpp"

namespace degs {
namespace {

// The largest number up to `most` that divides `number`.
int divisor_below(int most, int number) {
    while (most > 1 && number % most != 0) {
        --most;
    }
    return most;
}

} // namespace

void SpanPipelineConfig::describe(ConfigVisitor& visitor) {
    PipelineConfig::describe(visitor);
    visitor.choice(
        "span_ends", span_ends, {"exact", "outward", "slope"},
        "exact: the pixels inside the ellipse; outward: floor/ceil (paper, Eq. 15); slope: "
        "outward, plus |dw/dy| times half a unit of the mean (0 in fp32 and fp64)");
    visitor.integer("span_delta", span_delta, 0, 16,
                    "px added at both ends unless they are exact; the paper gives no value");
    if (span_ends == SpanEnds::Exact) {
        visitor.unused("span_delta", "span_ends", "span_ends is exact");
    }
}

void PortedPixelBufferConfig::describe(ConfigVisitor& visitor) {
    PixelBuffer::Config::describe(visitor);
    ports.describe(visitor,
                   "pixels read and pixels written by the tasks of a packet, per cycle and SRAM "
                   "bank; 0: unlimited [assumed]",
                   "SRAM banks of an Issue Bank's part of a tile context [assumed]");
}

void DegsConfig::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.integer("tile_size", tile_size, 4, 1024, "px (paper Table III: 16, 32, 64, 128)");
    visitor.integer(
        "clusters", clusters, 1, 64,
        "back ends on tiles of their own that share preprocessing, sorting and memory (paper: 1)");
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    pipeline.describe_records(visitor, traffic);
    visitor.section("projection", projection, "Projection Units");
    visitor.section("binning", binning, "tile lists");
    visitor.section("sorting", sorting, "Sorting Units");
    visitor.section("front", front, "Splat Supply between memory and clusters");
    visitor.section("fetching", fetching, "Splat Fetchers, one per Sorting Unit");
    visitor.section("gaussian_buffer", gaussian_buffer, "sorted splats and lists being sorted");
    visitor.section("slicing", slicing, "Gaussian Slicing Units");
    visitor.section("span_buffer", span_buffer, "row work items");
    visitor.section("span", span, "Span Units and spatial crossbar");
    visitor.section("scheduler", scheduler, "Issue Banks");
    visitor.section("packing", packing, "Packing Units and Packing Buffer");
    visitor.section("feature_buffer", feature_buffer, "Global Gaussian Parameters");
    visitor.section("array", array, "Blending Array");
    visitor.section("pixel_buffer", pixel_buffer, "tiles in flight");
    visitor.section("monitor", monitor, "cancellation of finished tiles");
    visitor.section("memory", memory, "off-chip memory");
    describe_cost(visitor);
    require_counts(visitor);
    require_sizes(visitor);
    require_packing(visitor);
    advise_supply(visitor);
    advise_depths(visitor);
}

TileCoupling DegsConfig::tile_coupling(bool array_only) const {
    if (clusters > 1 || array_only) {
        return TileCoupling::of_clusters(clusters);
    }
    if (front.cache_bytes != 0) {
        return {"The shared cache of this design keeps records between neighbouring tiles, of "
                "which a sample has few",
                "front.cache_bytes=0"};
    }
    if (front.multicast_window != 0) {
        return {"Fetchers of this design share records of neighbouring tiles, of which a sample "
                "has few",
                "front.multicast_window=0"};
    }
    if (streams() > 1) {
        return {"The tile streams of this design share its banks, so that a tile takes longer or "
                "shorter beside others",
                "slicing.interleave=1"};
    }
    return {};
}

void DegsConfig::require_sizes(ConfigVisitor& visitor) const {
    pixel_buffer.require_tiles(visitor, "pixel_buffer", tile_pixels(), streams(),
                               {"tile_size", "slicing.interleave"}, kMostContexts / clusters);
    visitor.require_at_least("span_buffer.bytes", span_buffer.bytes,
                             std::int64_t{span_buffer.row_bytes} * span_lanes() * streams(),
                             "to hold a row for every lane",
                             {"span_buffer.row_bytes", "span.count", "slicing.interleave"});
    visitor.require_at_least(
        "gaussian_buffer.bytes", gaussian_buffer.bytes,
        std::max(splat_share().least_buffer(chunk_bytes()),
                 sort_share().least_buffer(2 * traffic.list_entry_bytes)),
        "to hold a chunk of splats for every fetcher and two list entries for every Sorting Unit",
        {"gaussian_buffer.sort_share", "sorting.count", "slicing.interleave", "fetching.chunk",
         "traffic.splat_bytes"});
    visitor.require(!front.built() || front.fifo_splats >= fetchers() * fetching.chunk,
                    {"front.fifo_splats",
                     "must hold a chunk of splats for every fetcher of a cluster",
                     std::to_string(fetchers() * fetching.chunk),
                     {"fetching.chunk", "sorting.count", "slicing.interleave", "clusters"}});
    const int entry = feature_buffer.entry_bytes * scheduler.banks;
    visitor.require_at_least(
        "feature_buffer.bytes", feature_buffer.bytes, std::int64_t{entry} * streams(),
        "to hold a splat of every tile stream for every bank",
        {"feature_buffer.entry_bytes", "scheduler.banks", "slicing.interleave"});
    constexpr int kMostEntries = 65535; // entry numbers have 16 bits
    visitor.require(feature_entries() <= kMostEntries,
                    {"feature_buffer.bytes",
                     "must not hold more than 65535 splats per bank",
                     std::to_string(std::int64_t{entry} * kMostEntries),
                     {"feature_buffer.entry_bytes", "scheduler.banks"}});
}

// A segment can straddle one packet more than it fills. Limited ports end a packet where two pixels
// lie in one SRAM bank, which are at least as many pixels apart as there are banks.
int DegsConfig::packets_per_segment() const {
    const BankedSramPorts& ports = pixel_buffer.ports;
    const int pixels =
        ports.limited() ? std::min(array.pes_per_bank, ports.sram_banks) : array.pes_per_bank;
    return ceil_div(scheduler.segment_length, pixels) + 1;
}

void DegsConfig::require_packing(ConfigVisitor& visitor) const {
    const int packets = packets_per_segment();
    visitor.require_at_least("packing.lead_packets", packing.lead_packets, packets,
                             "because a segment may lie in that many packets",
                             {"scheduler.segment_length", "array.pes_per_bank",
                              "pixel_buffer.ports", "pixel_buffer.sram_banks"});
    const std::int64_t bank = std::int64_t{queue_depth()} * scheduler.segment_bytes +
                              std::int64_t{packets} * packing.task_bytes * array.pes_per_bank;
    visitor.require_at_least("packing.bytes", packing.bytes, bank * scheduler.banks,
                             "to hold the waiting segments and " + std::to_string(packets) +
                                 " packets of every bank",
                             {"scheduler.banks", "array.pes_per_bank",
                              "scheduler.queue_segments_per_pe", "scheduler.segment_length"});
}

// Each stage can supply the next one, as far as its numbers decide that alone.
void DegsConfig::advise_supply(ConfigVisitor& visitor) const {
    const int segments = ceil_div(array.pes_per_bank, scheduler.segment_length);
    const std::string fill = "should be at least " + std::to_string(segments) +
                             ", or a bank cannot fill a packet of its array slice in a cycle";
    visitor.advise(
        scheduler.issue_width >= segments,
        {"scheduler.issue_width", fill, "", {"array.pes_per_bank", "scheduler.segment_length"}});
    visitor.advise(scheduler.segments_per_cycle >= segments,
                   {"scheduler.segments_per_cycle",
                    fill,
                    "",
                    {"array.pes_per_bank", "scheduler.segment_length"}});
    const int pixels_per_unit = tile_size * span.rows_per_cycle; // in cycles_per_row cycles
    const int units = ceil_div(cluster_pes() * span.cycles_per_row, pixels_per_unit);
    visitor.advise(span.count >= units,
                   {"span.count",
                    "should be at least " + std::to_string(units) +
                        ", or the PEs starve even if every row is as wide as the tile",
                    "",
                    {"span.rows_per_cycle", "span.cycles_per_row", "tile_size", "scheduler.banks",
                     "array.pes_per_bank"}});
    const int rows = ceil_div(span.count * span.rows_per_cycle, span.cycles_per_row);
    const int rows_per_unit = ceil_div(rows, slicing.count);
    visitor.advise(
        slicing.rows_per_cycle >= rows_per_unit,
        {"slicing.rows_per_cycle",
         "should be at least " + std::to_string(rows_per_unit) + " to keep all Span Units busy",
         "",
         {"slicing.count", "span.count", "span.rows_per_cycle", "span.cycles_per_row"}});
}

// Queues cover the latencies that they hide, and nothing is larger than what may ever lie in it.
void DegsConfig::advise_depths(ConfigVisitor& visitor) const {
    const std::int64_t waiting = std::int64_t{queue_depth()} * scheduler.segment_length;
    const bool as_many_as_fit = scheduler.queue_segments_per_pe == 0;
    visitor.advise(waiting >= std::int64_t{scheduler.reuse_cycles} * array.pes_per_bank,
                   {as_many_as_fit ? "packing.bytes" : "scheduler.queue_segments_per_pe",
                    "should be so much that the waiting segments keep a slice busy for "
                    "scheduler.reuse_cycles cycles",
                    "",
                    {"scheduler.reuse_cycles", "scheduler.segment_length", "array.pes_per_bank"}});
    const std::int64_t used =
        std::int64_t{scheduler.banks} *
        (queue_depth() * scheduler.segment_bytes + packing.lead_packets * packet_bytes());
    visitor.advise_if_set(
        as_many_as_fit || packing.bytes <= used,
        {"packing.bytes",
         "has no effect above " + std::to_string(used) +
             ", which hold all segments and packets that may wait",
         "",
         {"packing.lead_packets", "scheduler.queue_segments_per_pe", "scheduler.segment_bytes"}});
}

SplatFetcher::Config DegsConfig::chunk_writers() const {
    SplatFetcher::Config writers = fetching;
    writers.splat_ports = gaussian_buffer.ports;
    writers.chunks = parameters_wait() ? gaussian_chunks() : 0;
    return writers;
}

IssueBank::Config DegsConfig::issue_bank(int first_context) const {
    IssueBank::Config bank = scheduler;
    bank.queue_depth = queue_depth();
    bank.spans_per_cycle = span.crossbar_width;
    bank.feature_entries = feature_entries();
    bank.open_splats = slicing.units_per_module();
    bank.streams = streams();
    bank.granted = granted();
    bank.first_context = first_context;
    bank.segment_ports = packing.segment_ports;
    bank.fill = feature_buffer.fill;
    return bank;
}

PackingUnit::Config DegsConfig::packing_unit() const {
    PackingUnit::Config unit = packing;
    unit.width = array.pes_per_bank;
    unit.depth = packing_lead();
    unit.ports = {pixel_buffer.ports, feature_buffer.fill.ports, tile_size, scheduler.banks};
    return unit;
}

ArraySlice::Config DegsConfig::array_slice(int first_context) const {
    ArraySlice::Config slice = array;
    slice.termination = scheduler.termination;
    slice.region_listeners = slicing.skip_dead_rows ? slicing.modules() : 0;
    slice.streams = streams();
    slice.granted = granted();
    slice.first_context = first_context;
    slice.contexts = contexts_per_stream();
    slice.scoreboard = scheduler.scoreboard;
    slice.tests = !span.parsing;
    return slice;
}

void DegsConfig::require_counts(ConfigVisitor& visitor) const {
    visitor.require(slicing.count % slicing.interleave == 0,
                    {"slicing.interleave",
                     "must divide slicing.count",
                     std::to_string(divisor_below(slicing.interleave, slicing.count)),
                     {"slicing.count"}});
    const int modules = std::max(1, slicing.modules());
    visitor.require(span.rows == RowAssignment::Pool || span.count % modules == 0,
                    {"slicing.count",
                     slicing.interleave > 1
                         ? "must be slicing.interleave times a divisor of span.count"
                         : "must divide span.count",
                     std::to_string(divisor_below(modules, span.count) * slicing.interleave),
                     {"slicing.interleave", "span.count", "slicing.distribution", "span.rows"}});
    visitor.require_at_least("scheduler.reuse_cycles", scheduler.reuse_cycles,
                             array.writeback_cycles, "to cover array.writeback_cycles",
                             {"array.writeback_cycles"});
}

} // namespace degs
