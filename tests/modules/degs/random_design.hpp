// SPDX-License-Identifier: Apache-2.0
// Random accelerators and frames, for what must hold of every design.
#pragma once

#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "tests/modules/degs/run_fixture.hpp"

namespace degs::test {

inline constexpr Shape kShapes[] = {
    {16, 1, 4, 4, 4}, {32, 2, 8, 8, 8}, {64, 4, 16, 16, 16}, // paper, Table III
    {16, 1, 4, 8, 4}, {16, 1, 8, 4, 4}, {32, 2, 6, 4, 4},    // Span Units and banks differ
    {16, 3, 9, 5, 3}, {8, 1, 1, 1, 2},  {32, 1, 2, 8, 1},    {8, 1, 3, 2, 8}, {128, 8, 32, 32, 32},
};

/// Draws until the sizes fit together.
class Draw {
public:
    explicit Draw(unsigned seed) : random_(seed) {}
    int upto(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n + 1)); }
    int among(std::initializer_list<int> values) {
        return values.begin()[upto(static_cast<int>(values.size()) - 1)];
    }
    bool chance(int of) { return upto(of - 1) == 0; }

    DegsConfig config(unsigned index) {
        for (;;) {
            DegsConfig c = candidate(index);
            if (c.problem().empty()) {
                return c;
            }
        }
    }

    /// Designs whose packets are only counted in exact mode, of one tile stream that goes round
    /// robin, or of several that share Span Units (SpanTurns).
    DegsConfig plain(unsigned index, bool several_streams = false) {
        for (;;) {
            DegsConfig c = candidate(index);
            const int streams = several_streams ? 2 + upto(2) : 1;
            c.slicing.count = c.slicing.count / c.slicing.interleave * streams;
            c.slicing.interleave = streams;
            c.span.rows = RowAssignment::Fixed;
            c.span.count = c.scheduler.banks;
            if (several_streams) {
                c.pixel_buffer.bytes *= streams;
                c.span_buffer.ports.ports = 0;
                c.gaussian_buffer.temporary = ParameterLife::Sliced;
                c.span.rows_per_cycle = c.span.cycles_per_row = 1;
            } else {
                c.scheduler.scan = DomainScan::RoundRobin;
            }
            c.scheduler.scoreboard = true;
            c.scheduler.select_cycles = 0;
            c.packing.reorganisation = true;
            c.feature_buffer.fill = FeatureBuffer::Fill();
            c.pixel_buffer.ports.ports = 0;
            if (c.problem().empty()) {
                return c;
            }
        }
    }

private:
    DegsConfig candidate(unsigned index) {
        // Every eighth run has 1024 PEs; the others share the small shapes.
        const unsigned small = std::size(kShapes) - 1;
        DegsConfig c = shaped({}, index % 16 == 15 ? kShapes[small] : kShapes[index % small]);
        arithmetic(c, index);
        scheduler(c);
        buffers(c);
        front_end(c);
        streams(c);
        ports(c);
        c.span.parsing = !chance(3);
        c.packing.reorganisation = !chance(3);
        const double ghz[] = {1.0, 1.0, 0.7, 1.7};
        c.clock_ghz = ghz[upto(3)];
        const double bandwidth[] = {204.8, 204.8, 51.2, 1.0, 1e5};
        c.memory.bandwidth_gb_per_s = bandwidth[upto(4)];
        const double latency[] = {100, 100, 0, 3.3, 1000};
        c.memory.latency_ns = latency[upto(4)];
        c.scheduler.select_cycles = among({0, 0, 1, 2, 3});
        return c;
    }
    void arithmetic(DegsConfig& c, unsigned index) {
        if (index % 2 == 0) {
            c = exact_arithmetic(c);
            return;
        }
        c.pipeline.numbers =
            static_cast<Arithmetic>(upto(static_cast<int>(arithmetic_names().size()) - 1));
        c.pipeline.span_ends = static_cast<SpanEnds>(upto(2));
        c.pipeline.span_delta = chance(3) ? 1 : 0;
        c.pipeline.stop_rule = chance(3) ? StopRule::After : StopRule::Refuse;
    }
    void scheduler(DegsConfig& c) {
        c.scheduler.queue_segments_per_pe = among({1, 2, 4, 9, 0});
        c.scheduler.segment_length = among({16, 16, 16, 8, 32, 5});
        c.scheduler.segments_per_cycle = among({1, 2, 4});
        c.scheduler.issue_width = among({1, 2, 4, 8});
        c.scheduler.reuse_cycles = among({4, 4, 7, 13});
        c.scheduler.termination = static_cast<TerminationGrain>(upto(2));
        c.scheduler.scan = static_cast<DomainScan>(upto(2));
        c.scheduler.scoreboard = !chance(8);
        c.packing.latency_cycles = among({1, 2, 2, 5});
        c.packing.lead_packets = among({5, 3, 17, 1000});
        c.packing.packets_per_cycle = among({1, 1, 2, 64});
        c.scheduler.tiles = among({0, 0, 1, 3});
        c.array.writeback_cycles = among({4, 4, 1, 3});
    }
    void buffers(DegsConfig& c) {
        c.pixel_buffer.bytes *= among({1, 1, 2, 4});
        c.pixel_buffer.readout_pixels = among({64, 1, 7, 1024});
        c.pixel_buffer.release = chance(2) ? ContextRelease::Bank : ContextRelease::Tile;
        c.pixel_buffer.writes_in_flight = among({4, 1});
        c.packing.bytes = chance(2) ? c.packing.bytes : among({1024, 2048, 8192, 16384});
        c.feature_buffer.bytes =
            chance(2) ? c.feature_buffer.bytes : 16 * c.scheduler.banks * among({1, 2, 5});
        c.span_buffer.bytes = chance(2) ? c.span_buffer.bytes : 8 * c.span.count * among({1, 2});
        c.gaussian_buffer.bytes =
            chance(2) ? c.gaussian_buffer.bytes : among({256, 1024, 2048, 4096});
    }
    void streams(DegsConfig& c) {
        c.slicing.interleave = among({1, 1, 2, 3, 4});
        c.slicing.count *= c.slicing.interleave;
        c.pixel_buffer.bytes *= chance(2) ? c.slicing.interleave : 1;
        c.span_buffer.bytes *= chance(2) ? c.slicing.interleave : 1;
        c.clusters = among({1, 1, 2, 3, 5});
        c.span.rows = chance(3) ? RowAssignment::Pool : RowAssignment::Fixed;
        c.span.rows_per_cycle = among({1, 1, 1, 2, 5});
        c.span.crossbar_width = among({0, 0, 1, 2});
    }
    void ports(DegsConfig& c) {
        c.gaussian_buffer.ports.ports = among({0, 0, 1, 2});
        c.gaussian_buffer.ports.sram_banks = among({1, 1, 3});
        c.gaussian_buffer.temporary = chance(3) ? ParameterLife::Spans : ParameterLife::Sliced;
        c.span_buffer.ports.ports = among({0, 0, 1, 2});
        c.packing.segment_ports.ports = among({0, 0, 1, 2});
        c.feature_buffer.fill.cycles = among({0, 1, 5});
        c.feature_buffer.fill.ports.ports = among({0, 0, 1, 2});
        c.feature_buffer.fill.ports.sram_banks = among({1, 2, 8});
        c.pixel_buffer.ports.ports = among({0, 0, 1, 2});
        c.pixel_buffer.ports.sram_banks = among({16, 8, 3, 1, 64});
    }
    void front_end(DegsConfig& c) {
        c.projection.chunk = among({64, 8, 1});
        c.projection.chunks_in_flight = among({4, 1});
        c.sorting.count = among({4, 1, 2, 3});
        c.fetching.chunk = among({16, 1, 4});
        c.fetching.chunks_in_flight = among({8, 1, 2});
        c.slicing.rows_per_cycle = among({1, 4, 8});
        c.slicing.splats_per_cycle = among({1, 1, 2, 3});
        c.slicing.distribution = static_cast<SliceDistribution>(among({0, 1, 2}));
        c.slicing.skip_dead_rows = chance(2);
        c.slicing.feedback_cycles = among({1, 4, 20});
        c.slicing.rows = chance(2) ? SlicedRows::Tile : SlicedRows::Splat;
        c.span.latency_cycles = among({1, 6});
        c.span.cycles_per_row = among({1, 1, 2});
        c.span.crossbar_depth = among({2, 1, 8});
        c.monitor.cancel = !chance(3);
        c.monitor.latency_cycles = among({8, 1, 50});
        c.binning.writes_in_flight = among({8, 1});
        c.tile_order = static_cast<TileOrder>(among({0, 1}));
        if (chance(2)) {
            c.front.splats_per_cycle = among({0, 1, 5, 16});
            c.front.fifo_splats = among({256, 32, 8});
            c.front.multicast_window = among({0, 8, 64});
            c.front.cache_bytes = among({0, 2048});
        }
    }
    std::mt19937 random_;
};

inline std::string describe(const DegsConfig& c) {
    return std::to_string(c.tile_size) + " px tiles, " + std::to_string(c.slicing.count) + "/" +
           std::to_string(c.span.count) + "/" + std::to_string(c.scheduler.banks) + "/" +
           std::to_string(c.array.pes_per_bank) + ", " + std::to_string(c.contexts()) +
           " contexts, scan " + std::to_string(static_cast<int>(c.scheduler.scan)) + ", chosen " +
           std::to_string(c.scheduler.select_cycles) + " cycles before, " +
           std::to_string(c.clusters) + " clusters of " + std::to_string(c.streams()) +
           " streams, " + (c.span.rows == RowAssignment::Pool ? "pool of " : "fixed ") +
           std::to_string(c.span.rows_per_cycle) + " per " + std::to_string(c.span.cycles_per_row) +
           " cycles, crossbar " + std::to_string(c.span.crossbar_width) +
           (c.span.parsing ? "" : ", rows not solved") +
           (c.packing.reorganisation ? "" : ", spans not compacted");
}

inline std::vector<FrameWorkload> draw_frames(unsigned index, Draw& draw,
                                              const DegsConfig& config) {
    const bool large = config.pes() >= 256;
    std::vector<FrameWorkload> frames;
    for (int f = draw.chance(4) ? 2 : 1; f > 0; --f) {
        const int width = 1 + draw.upto(large ? 200 : 90);
        const int height = 1 + draw.upto(large ? 150 : 70);
        frames.push_back(random_frame(index * 10 + static_cast<unsigned>(f), width, height,
                                      config.tile_size,
                                      draw.among({1, 10, 60, 150, large ? 300 : 200})));
    }
    return frames;
}

inline std::vector<const FrameWorkload*> pointers_to(const std::vector<FrameWorkload>& frames) {
    std::vector<const FrameWorkload*> list;
    list.reserve(frames.size());
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    return list;
}

} // namespace degs::test
