// SPDX-License-Identifier: Apache-2.0
// Issue Bank, Packing Unit and array slice together, fed with spans at chosen dates.
#pragma once

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "modules/degs/array/blending_array.hpp"
#include "modules/degs/scheduler/issue_bank.hpp"
#include "tests/modules/degs/workload_fixture.hpp"
#include "tests/tlm/event_reader.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {

/// One bank that owns every row, with its slice. Packets of `width` tasks.
struct SchedulerBench {
    struct Sizes {
        int width = 16;
        int packing_latency = 2;
        int reuse = 4;
        int writeback = 4;
        int queue = 64;
        int segments_per_cycle = 4;
        int issue_width = 4;
        int select_cycles = 0;
        int packets = 64;
        int spans_per_cycle = 0;
        int segment_ports = 0;
        int fill_cycles = 0;
        int segment_length = 16;
        bool scoreboard = true;
        DomainScan scan = DomainScan::RoundRobin;
        TerminationGrain grain = TerminationGrain::Segment;
    };
    /// A span enters the bank at `date`, from the crossbar of one Span Unit.
    struct Feed {
        Cycle date;
        std::uint32_t splat;
        int row;
        TileNumber tile = 0;
    };

    Sizes sizes;
    Timebase time;
    FrameWorkload frame;
    RenderJob job;
    DatedFifo<SpanItem> crossbar{"crossbar", time, 1024};
    DatedFifo<TaskPacket> packets;
    DatedFifo<Termination> terminated;
    DatedFifo<SliceReport> done, state;
    DatedFifo<TileNumber> contexts{"contexts", time, 8};
    PackingUnit packing;
    IssueBank bank;
    ArraySlice slice;
    Process feeder{time}, pixels{time}, monitor{time};
    std::vector<std::unique_ptr<Script>> scripts;
    std::vector<Cycle> tile_done, tile_state; ///< dates of the reports
    Cycle next_context = kNever;              ///< date at which the second tile may start

    SchedulerBench(const Sizes& s, const std::vector<ProjectedSplat>& splats, int tile = 16,
                   int tiles = 1)
        : sizes(s), frame(make_frame(splats, tile * tiles, tile, tile)),
          job(make_render_job({&frame},
                              {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, {}}, 1)),
          packets("packets", time, static_cast<std::size_t>(s.packets) + s.packing_latency + 4,
                  static_cast<Cycle>(s.packing_latency)),
          terminated("terminated", time, 4096, static_cast<Cycle>(s.writeback)),
          done("done", time, 8, static_cast<Cycle>(s.writeback)),
          state("state", time, 8, static_cast<Cycle>(s.writeback)),
          packing("packing", packing_config(s)),
          bank("bank", bank_config(s), time, job, packing, 0, 1, 1),
          slice("slice", slice_config(s), time, job, 0, 1, s.segment_length) {
        bank.in[0].bind(crossbar);
        bank.terminated.bind(terminated);
        bank.context_free[0].bind(contexts);
        packing.out.bind(packets);
        slice.in.bind(packets);
        slice.terminated.bind(terminated);
        slice.tile_done[0].bind(done);
        slice.tile_state[0].bind(state);
        for (int row = 0; row < tile; ++row) {
            job.path->begin_row(0, row);
        }
    }
    static IssueBank::Config bank_config(const Sizes& s) {
        IssueBank::Config c;
        c.banks = 1;
        c.queue_depth = s.queue;
        c.segment_length = s.segment_length;
        c.scan = s.scan;
        c.segments_per_cycle = s.segments_per_cycle;
        c.spans_per_cycle = s.spans_per_cycle;
        c.issue_width = s.issue_width;
        c.select_cycles = s.select_cycles;
        c.segment_ports.ports = s.segment_ports;
        c.fill.cycles = s.fill_cycles;
        c.reuse_cycles = s.reuse;
        c.feature_entries = 256;
        c.scoreboard = s.scoreboard;
        c.termination = s.grain;
        return c;
    }
    static PackingUnit::Config packing_config(const Sizes& s) {
        PackingUnit::Config c;
        c.width = s.width;
        c.latency_cycles = s.packing_latency;
        c.depth = s.packets;
        return c;
    }
    static ArraySlice::Config slice_config(const Sizes& s) {
        ArraySlice::Config c;
        c.pes_per_bank = s.width;
        c.writeback_cycles = s.writeback;
        c.termination = s.grain;
        c.scoreboard = s.scoreboard;
        return c;
    }

    /// Rows of one splat, all at one date or one per cycle.
    static std::vector<Feed> rows(std::uint32_t splat, int count, Cycle date, Cycle step = 0) {
        std::vector<Feed> list;
        for (int row = 0; row < count; ++row) {
            list.push_back({date + step * static_cast<Cycle>(row), splat, row});
        }
        return list;
    }
    void run(const std::vector<Feed>& feeds) {
        crossbar.connect_writer(feeder);
        scripts.push_back(std::make_unique<Script>("feed", [this, feeds] { feed(feeds); }));
        scripts.push_back(std::make_unique<Script>("pixels", [this] {
            contexts.connect_writer(pixels);
            for (TileNumber tile = 0; tile < job.tiles.size(); ++tile) {
                done.get(pixels);
                tile_done.push_back(pixels.local());
                for (int row = 0; row < job.tile_size; ++row) {
                    job.path->begin_row(0, row);
                }
                if (tile + 1 < job.tiles.size()) {
                    pixels.advance_to(next_context - 1);
                    contexts.put(pixels, tile + 1);
                }
            }
            pixels.finish();
        }));
        scripts.push_back(std::make_unique<Script>("monitor", [this] {
            for (std::size_t tile = 0; tile < job.tiles.size(); ++tile) {
                state.get(monitor);
                tile_state.push_back(monitor.local());
            }
        }));
        sc_core::sc_start();
        EXPECT_EQ(tile_done.size(), job.tiles.size()) << "the bench did not come to its end";
        EXPECT_EQ(stats().packets, packing.stats().packets);
    }
    void feed(const std::vector<Feed>& feeds) {
        TileNumber tile = 0;
        const auto end_tile = [this, &tile] {
            SpanItem item;
            item.tile = tile++;
            crossbar.put(feeder, item);
        };
        for (const Feed& f : feeds) {
            while (tile < f.tile) {
                end_tile();
            }
            feeder.advance_to(f.date - 1); // the ring takes a cycle
            SpanItem item;
            item.tile = f.tile;
            const JobTile& t = job.tiles[f.tile];
            item.span = job.path->solve_row(f.splat, t.y + f.row, t.x, t.x + t.width, t.y);
            ASSERT_TRUE(item.span);
            crossbar.put(feeder, item);
        }
        while (tile < job.tiles.size()) {
            end_tile();
        }
        feeder.finish();
    }
    /// The cycles in which run() takes the spans of tile 0.
    std::vector<Cycle> run_and_list_takes(const std::vector<Feed>& feeds) {
        EventLog log;
        bank.log_to(log);
        run(feeds);
        std::vector<Cycle> takes;
        for (const LoggedEvent& event : events_of(log)) {
            if (event.kind() == "span" && event["end"] == 0) {
                takes.push_back(event.now);
            }
        }
        return takes;
    }
    /// Row and cycle of every segment that run() issues.
    std::vector<std::pair<int, Cycle>> run_and_list_issues(const std::vector<Feed>& feeds) {
        EventLog log;
        bank.log_to(log);
        run(feeds);
        std::vector<std::pair<int, Cycle>> issues;
        for (const LoggedEvent& event : events_of(log)) {
            if (event.kind() == "issue") {
                issues.emplace_back(static_cast<int>(event["domain"]), event.now);
            }
        }
        return issues;
    }
    const ArraySlice::Stats& stats() const { return slice.stats(); }
    /// The slots between first and last execution: executed tasks and idle ones.
    std::uint64_t accounted() const {
        const SlotAccount& s = stats().slots;
        return s[Slot::Useful] + s[Slot::Boundary] + s[Slot::Terminated] + packing.idle().total();
    }
    std::uint64_t window_slots() const {
        return stats().window.cycles() * static_cast<std::uint64_t>(sizes.width);
    }
};

} // namespace degs::test
