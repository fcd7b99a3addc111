// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/degs_config.hpp"

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

void DegsConfig::Pipeline::describe(ConfigVisitor& visitor) {
    PipelineConfig::describe(visitor);
    visitor.choice(
        "span_ends", span_ends, {"exact", "outward", "slope"},
        "exact: ceil/floor, the pixels inside the ellipse; outward: floor/ceil (paper, Eq. 15); "
        "slope: outward, and where |dw/dy| times half a unit of the mean makes it a px more (0 in "
        "fp32 and fp64); a number set's own ends do not count");
    visitor.integer(
        "span_delta", span_delta, 0, 16,
        "px added at both ends unless they are exact; the paper gives no value, 0 is the minimum");
    if (span_ends == SpanEnds::Exact) {
        visitor.unused("span_delta", "span_ends", "span_ends is exact");
    }
}

void DegsConfig::GaussianBuffer::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 256, 1 << 30, "bytes (paper Table I: 72 KB)");
    visitor.real(
        "sort_share", sort_share, 0.05, 0.95,
        "share of the buffer for lists being sorted; the rest holds sorted splats [assumed]");
    ports.describe(visitor,
                   "splats written by a fetcher, and read by the Slicing Units that share a part, "
                   "per cycle and SRAM bank; 0: unlimited [assumed]",
                   "SRAM banks of such a part; splats are dealt to them in turn [assumed]");
    visitor.choice("temporary", temporary, {"sliced", "spans"},
                   "how long a chunk of splats keeps its place: until a Slicing Unit has taken the "
                   "last one [assumed: rows carry what Span Units need], or until the spans of all "
                   "of them have been made (paper, Sec. IV-A)");
}

void DegsConfig::SpanBuffer::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 8, 1 << 30,
                    "bytes (paper Table I: 2 KB), split among Span Units");
    visitor.integer("row_bytes", row_bytes, 1, 256,
                    "bytes per row work item: G_ID 4, row 2, tags 2 [assumed]");
    ports.describe(visitor, "rows written and rows read per cycle and lane, which is an SRAM bank; "
                            "0: unlimited [assumed]");
}

void DegsConfig::Scheduler::describe(ConfigVisitor& visitor) {
    visitor.integer("banks", banks, 1, 64,
                    "Issue Banks, Packing Units and array slices (paper Table II)");
    visitor.integer(
        "queue_segments_per_pe", queue_segments_per_pe, 0, kMostSegmentsPerPe,
        "segments waiting per bank and PE of its slice; a fixed 32 starves wide banks; 0: what "
        "packing.bytes leaves beside packing.lead_packets [assumed]");
    visitor.integer(
        "segment_bytes", segment_bytes, 1, 256,
        "bytes per waiting segment, part of packing.bytes: g0 4, d0 4, G_ID 2, mask and "
        "link 2 [assumed]");
    visitor.integer("segment_length", segment_length, 1, 32,
                    "px, stride of the Segmenter (paper: 1 x 16)");
    visitor.integer("segments_per_cycle", segments_per_cycle, 1, 64,
                    "segments cut and queued per bank and cycle [assumed]");
    visitor.integer(
        "issue_width", issue_width, 1, 64,
        "segments issued per bank and cycle; one per four PEs keeps the prefix sum short "
        "[assumed]");
    visitor.integer(
        "reuse_cycles", reuse_cycles, 1, 64,
        "cycles between two updates of a segment (paper: 4); not below array.writeback_cycles");
    visitor.boolean("scoreboard", scoreboard,
                    "enforce reuse_cycles; false shows what it is for: a pixel that comes again "
                    "before its write-back reads the older state, and the image is wrong");
    visitor.choice(
        "termination", termination, {"segment", "task", "pixel"},
        "what is skipped: all segments of a region of segment_length pixels that has ended "
        "(paper), segments whose own pixels have all ended, or single ended pixels");
    visitor.choice("scan", scan, {"round_robin", "oldest", "deepest"},
                   "which ready conflict domain issues first [assumed]");
}

void DegsConfig::Packing::describe(ConfigVisitor& visitor) {
    visitor.integer(
        "bytes", bytes, 16, 1 << 30,
        "bytes (paper Table I: 32 KB), split among banks: waiting segments, then packets");
    visitor.integer("task_bytes", task_bytes, 1, 256,
                    "bytes per task: G_ID, x, y, n, g0, d0, tags [assumed]");
    visitor.integer("lead_packets", lead_packets, 1, 65536,
                    "packets of a bank that may wait for its array slice; what is packed earlier "
                    "cannot be dropped any more when its pixels end, so a longer lead only adds "
                    "terminated tasks [assumed]");
    visitor.integer("latency_cycles", latency_cycles, 1, 64,
                    "cycles from issue to execution: prefix sum and shift, buffer read [assumed]");
    visitor.boolean("reorganisation", reorganisation,
                    "compact tasks of different spans into one packet (paper, Sec. IV-B); false, "
                    "for ablations: a packet has tasks of one span only");
    ports.describe(visitor, "segments written and segments read per cycle and bank; packets lie in "
                            "a memory of their own; 0: unlimited [assumed]");
}

void DegsConfig::Array::describe(ConfigVisitor& visitor) {
    visitor.integer("pes_per_bank", pes_per_bank, 1, TaskPacket::kMaxRuns,
                    "PEs per array slice (paper Table II)");
    visitor.integer("writeback_cycles", writeback_cycles, 1, 64,
                    "cycles from execution to written-back pixel state and feedback (paper: 4)");
}

void DegsConfig::FeatureBuffers::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 16, 1 << 30, "bytes (paper Table I: 8 KB), split among banks");
    visitor.integer("entry_bytes", entry_bytes, 1, 256,
                    "bytes per splat: A, three colours, tag [assumed]");
    visitor.integer("fill_cycles", fill.cycles, 0, 1024,
                    "cycles that writing an entry takes, with which its first span waits unless "
                    "the Packing Unit's pipeline hides it; 0: it is there at once [assumed]");
    fill.ports.describe(visitor,
                        "splats written, and splats read by the tasks of a packet, per cycle and "
                        "SRAM bank; 0: unlimited [assumed]",
                        "SRAM banks of an Issue Bank's part; entries are dealt to them in turn "
                        "[assumed]");
}

void DegsConfig::PixelBuffers::describe(ConfigVisitor& visitor) {
    PixelBuffer::Config::describe(visitor);
    ports.describe(visitor,
                   "pixels read and pixels written by the tasks of a packet, per cycle and SRAM "
                   "bank; 0: unlimited [assumed]",
                   "SRAM banks of an Issue Bank's part of a tile context; pixels are dealt to them "
                   "in turn, row after row [assumed]");
}

void DegsConfig::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.integer("tile_size", tile_size, 4, 1024, "px (paper Table II: 16, 32, 64, 128)");
    visitor.integer("clusters", clusters, 1, 64,
                    "back ends that share preprocessing, sorting and memory, each on tiles of its "
                    "own; what the sections from fetching to monitor say, without projection, "
                    "binning and sorting, is that of one cluster (paper: 1)");
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    pipeline.require_records(visitor, traffic.sh_value_bytes, traffic.list_entry_bytes);
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
    constexpr int kMostEntries = 65535; // their numbers have 16 bits
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
