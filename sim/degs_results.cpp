// SPDX-License-Identifier: Apache-2.0
// The counters of DeGS in the terms that all accelerators share.
#include <algorithm>

#include "sim/degs_run.hpp"
#include "sim/words.hpp"

namespace degs::sim {
namespace {

/// Sums one counter over units of a kind.
template <class Units, class Stats>
std::uint64_t sum_of(const Units& units, std::uint64_t Stats::*counter) {
    std::uint64_t sum = 0;
    for (const auto& unit : units) {
        sum += unit->stats().*counter;
    }
    return sum;
}

/// PE-cycles of the whole array: executed tasks, idle slots between packets, and what a slice
/// missed of the window before its first and after its last packet.
void collect_slots(const Degs& degs, AcceleratorResult& result) {
    for (const auto& slice : degs.slices()) {
        result.slots += slice->stats().slots;
        result.window.include(slice->stats().window);
        result.hazards += slice->stats().hazards;
    }
    const auto width = static_cast<std::uint64_t>(degs.config().array.pes_per_bank);
    for (std::size_t b = 0; b < degs.slices().size(); ++b) {
        result.slots += degs.packing()[b]->idle();
        const ActiveWindow& own = degs.slices()[b]->stats().window;
        if (own.empty()) {
            result.slots.drain += result.window.cycles() * width;
        } else {
            result.slots.starved += (own.first - result.window.first) * width;
            result.slots.drain += (result.window.last - own.last) * width;
        }
    }
}

class StageList {
public:
    explicit StageList(AcceleratorResult& result) : result_(result) {}
    void add(const char* name, std::size_t units, std::uint64_t busy_cycles, Counts counts) {
        StageUse stage;
        stage.name = name;
        stage.units = static_cast<int>(units);
        stage.busy_cycles = static_cast<double>(busy_cycles);
        stage.busy = result_.cycles == 0
                         ? 0.0
                         : stage.busy_cycles /
                               (static_cast<double>(units) * static_cast<double>(result_.cycles));
        stage.counts = std::move(counts);
        result_.stages.push_back(std::move(stage));
    }

private:
    AcceleratorResult& result_;
};

void collect_front_stages(const Degs& degs, StageList& stages) {
    const auto& projection = degs.projection();
    using P = ProjectionUnit::Stats;
    // Projecting and shading overlap: the unit is as busy as the busier of the two.
    stages.add("projection", projection.size(),
               std::max(sum_of(projection, &P::project_busy), sum_of(projection, &P::shade_busy)),
               {{"gaussians", sum_of(projection, &P::gaussians)},
                {"visible", sum_of(projection, &P::visible)}});
    const auto& sorting = degs.sorting();
    using S = SortingUnit::Stats;
    stages.add("sorting", sorting.size(), sum_of(sorting, &S::sort_busy),
               {{"keys", sum_of(sorting, &S::keys)},
                {"memory_passes", sum_of(sorting, &S::memory_passes)},
                {"records", sum_of(sorting, &S::records)},
                {"records_cancelled", sum_of(sorting, &S::records_cancelled)}});
    const auto& slicing = degs.slicing();
    using G = GaussianSlicingUnit::Stats;
    stages.add("slicing", slicing.size(), sum_of(slicing, &G::busy),
               {{"splats", sum_of(slicing, &G::splats)},
                {"splats_cancelled", sum_of(slicing, &G::splats_cancelled)},
                {"rows", sum_of(slicing, &G::rows)}});
}

void collect_back_stages(const Degs& degs, StageList& stages) {
    const auto& spans = degs.spans();
    using U = SpanUnit::Stats;
    stages.add("span", spans.size(), sum_of(spans, &U::busy),
               {{"rows", sum_of(spans, &U::rows)},
                {"empty_rows", sum_of(spans, &U::empty_rows)},
                {"spans", sum_of(spans, &U::spans)},
                {"tasks", sum_of(spans, &U::tasks)}});
    const auto& banks = degs.banks();
    using B = IssueBank::Stats;
    stages.add("packing", banks.size(), sum_of(banks, &B::busy),
               {{"tasks_in", sum_of(banks, &B::tasks_in)},
                {"tasks_issued", sum_of(banks, &B::tasks_issued)},
                {"tasks_dropped", sum_of(banks, &B::tasks_dropped)},
                {"segments_issued", sum_of(banks, &B::segments_issued)},
                {"segments_dropped", sum_of(banks, &B::segments_dropped)},
                {"packets", sum_of(degs.packing(), &PackingUnit::Stats::packets)}});
    const auto& slices = degs.slices();
    using A = ArraySlice::Stats;
    stages.add("blending", slices.size(), sum_of(slices, &A::packets),
               {{"packets", sum_of(slices, &A::packets)},
                {"pixels_ended", sum_of(slices, &A::pixels_ended)}});
}

BufferUse ring_buffer(const char* name, int bytes, int depth, const Degs::RingUse& use,
                      Cycle cycles) {
    BufferUse buffer;
    buffer.name = name;
    buffer.bytes = bytes;
    buffer.depth = static_cast<std::uint64_t>(depth);
    buffer.rings = use.depth / buffer.depth;
    buffer.high_water = use.high_water;
    if (cycles != 0 && use.depth != 0) {
        buffer.mean_fill = static_cast<double>(use.occupied_cycles) /
                           (static_cast<double>(use.depth) * static_cast<double>(cycles));
    }
    buffer.full_cycles = use.full_cycles;
    buffer.empty_cycles = use.empty_cycles;
    return buffer;
}

void collect_buffers(const Degs& degs, AcceleratorResult& result) {
    const DegsConfig& c = degs.config();
    const auto ring = [&](const char* name, int bytes, int depth, const Degs::RingUse& use) {
        result.buffers.push_back(ring_buffer(name, bytes, depth, use, result.cycles));
    };
    ring("gaussian_buffer", c.gaussian_buffer.bytes, c.gaussian_chunks(), degs.gaussian_buffer());
    ring("span_buffer", c.span_buffer.bytes, c.span_lane_depth(), degs.span_buffer());
    ring("crossbar", 0, c.span.crossbar_depth, degs.crossbar());
    // Four cells more than the buffer has: tile ends travel in them, see Degs::build_array().
    ring("packing_buffer", c.packing.bytes, c.packing_depth() + 4, degs.packing_buffer());
    std::uint64_t waits = 0;
    for (const auto& bank : degs.banks()) {
        waits += bank->feature_waits();
    }
    BufferUse feature;
    feature.name = "feature_buffer";
    feature.bytes = c.feature_buffer.bytes;
    feature.counts = {{"banks", degs.banks().size()},
                      {"entries_per_bank", static_cast<std::uint64_t>(c.feature_entries())},
                      {"waits", waits}};
    result.buffers.push_back(feature);
    using P = PixelBuffer::Stats;
    BufferUse pixel;
    pixel.name = "pixel_buffer";
    pixel.bytes = c.pixel_buffer.bytes;
    pixel.counts = {{"contexts", static_cast<std::uint64_t>(c.contexts())},
                    {"readout_cycles", sum_of(degs.pixel_buffers(), &P::readout_busy)},
                    {"write_wait_cycles", sum_of(degs.pixel_buffers(), &P::write_wait)}};
    result.buffers.push_back(pixel);
}

void collect_memory(const Degs& degs, AcceleratorResult& result) {
    const auto& names = degs.stream_of_initiator();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Memory::Stats& stats = degs.memory().stats(i);
        auto stream = std::find_if(result.streams.begin(), result.streams.end(),
                                   [&](const StreamUse& s) { return s.name == names[i]; });
        if (stream == result.streams.end()) {
            stream = result.streams.insert(stream, StreamUse{names[i], 0, 0, 0});
        }
        stream->bytes_read += stats.bytes_read;
        stream->bytes_written += stats.bytes_written;
        stream->requests += stats.reads + stats.writes;
    }
    result.memory_gb_per_s = degs.config().memory.bandwidth_gb_per_s;
    const double frame_ns = static_cast<double>(result.cycles) / result.clock_ghz;
    if (frame_ns > 0) {
        result.memory_utilization = degs.memory().total().busy_ns / frame_ns;
    }
}

void collect_laws(const Degs& degs, AcceleratorResult& result) {
    using B = IssueBank::Stats;
    const std::uint64_t in = sum_of(degs.banks(), &B::tasks_in);
    const std::uint64_t issued = sum_of(degs.banks(), &B::tasks_issued);
    const std::uint64_t dropped = sum_of(degs.banks(), &B::tasks_dropped);
    const std::uint64_t packed = sum_of(degs.packing(), &PackingUnit::Stats::tasks);
    const SlotAccount& s = result.slots;
    result.conservation = {
        {"tasks solved = tasks into the banks", sum_of(degs.spans(), &SpanUnit::Stats::tasks), in},
        {"tasks into the banks = issued + dropped", in, issued + dropped},
        {"tasks issued = packed", issued, packed},
        {"tasks packed = executed", packed, s.useful + s.boundary + s.terminated},
        {"packets packed = executed", sum_of(degs.packing(), &PackingUnit::Stats::packets),
         sum_of(degs.slices(), &ArraySlice::Stats::packets)},
    };
}

void explain_degs(const Degs& degs, AcceleratorResult& result) {
    auto& out = result.left_out;
    const std::uint64_t all_tiles = result.tiles + result.background_tiles;
    out.push_back(grouped(result.background_tiles) + " of " + grouped(all_tiles) +
                  " tiles list no splat: they are written as background and enter no unit.");
    using S = SortingUnit::Stats;
    const std::uint64_t skipped = sum_of(degs.sorting(), &S::records_cancelled);
    out.push_back(grouped(result.tiles_cancelled) +
                  " tiles were cancelled before the end of their list because all their pixels had "
                  "ended: " +
                  grouped(skipped) + " splat records were not fetched, " +
                  grouped(sum_of(degs.slicing(), &GaussianSlicingUnit::Stats::splats_cancelled)) +
                  " fetched ones were not sliced.");
    out.push_back(grouped(sum_of(degs.banks(), &IssueBank::Stats::tasks_dropped)) +
                  " tasks of ended pixels were dropped by the Issue Banks and cost no PE slot.");
    out.push_back(grouped(sum_of(degs.spans(), &SpanUnit::Stats::empty_rows)) +
                  " rows of splats cover no pixel of their tile: they cost a Span Unit cycle and "
                  "nothing after it.");
    out.emplace_back(
        "The memory is a shared data bus with latency: its banks, rows and refresh are "
        "not modelled, so there is no row hit rate.");
    out.emplace_back(
        "Only what is written to the frame buffer exists as bytes in memory; the other "
        "streams cost their time and carry no data.");
}

} // namespace

std::uint64_t finished_tiles(const Degs& degs) {
    std::uint64_t tiles = ~std::uint64_t{0};
    for (const auto& part : degs.pixel_buffers()) {
        tiles = std::min(tiles, part->stats().tiles);
    }
    return tiles;
}

void collect_degs(const Degs& degs, AcceleratorResult& result) {
    const DegsConfig& config = degs.config();
    result.name = config.name;
    result.pes = config.pes();
    result.clock_ghz = config.clock_ghz;
    result.cycles = degs.finished();
    result.preprocessing_cycles = degs.binner().stats().frame_binned;
    result.tiles = finished_tiles(degs);
    result.background_tiles = sum_of(degs.pixel_buffers(), &PixelBuffer::Stats::background_tiles);
    result.tiles_cancelled = degs.monitor().stats().tiles_cancelled;
    collect_slots(degs, result);
    StageList stages(result);
    collect_front_stages(degs, stages);
    collect_back_stages(degs, stages);
    collect_buffers(degs, result);
    collect_memory(degs, result);
    collect_laws(degs, result);
    explain_degs(degs, result);
}

} // namespace degs::sim
