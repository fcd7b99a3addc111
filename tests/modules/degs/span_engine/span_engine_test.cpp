// SPDX-License-Identifier: Apache-2.0
// Span Units, Tile Monitor and Pixel Buffer, one at a time:
// dates against closed formulas.
#include "modules/degs/span_engine/span_pool.hpp"
#include "modules/degs/span_engine/span_unit.hpp"
#include "modules/kit/front_end/tile_monitor.hpp"
#include "modules/kit/pixels/pixel_buffer.hpp"
#include "tests/modules/kit/job/unit_bench.hpp"
#include "tlm/memory.hpp"

namespace degs {
namespace {

using test::blanket;
using test::make_frame;
using test::one_pixel;
using test::one_row;
using test::UnitBench;

// A row per cycles_per_row; its span is there a latency later; an empty row costs its cycle too.
TEST(SpanUnit, ARowPerIntervalAndTheLatencyOfThePipeline) {
    UnitBench bench(make_frame({one_row(2, 9, 1), one_row(2, 9, 3)}, 16, 16, 16));
    SpanUnit::Config config;
    config.count = 1;
    config.cycles_per_row = 3;
    SpanUnit unit("unit", config, bench.time, bench.job, 0, 2);
    DatedFifo<RowItem> rows("rows", bench.time, 16);
    DatedFifo<SpanItem> bank0("bank0", bench.time, 8, 6);
    DatedFifo<SpanItem> bank1("bank1", bench.time, 8, 6);
    unit.in[0].bind(rows);
    unit.out[0].bind(bank0);
    unit.out[1].bind(bank1);
    bench.script([&](Process& self) {
        rows.connect_writer(self);
        self.advance(19);
        for (const int row : {1, 2, 3}) { // splat 0 covers row 1 alone, splat 1 row 3
            RowItem item;
            item.splat = row == 3 ? 1 : 0;
            item.row = static_cast<std::int16_t>(row);
            rows.put(self, item);
        }
        RowItem end;
        end.end = true;
        rows.put(self, end);
    });
    const auto& even = bench.drain(bank0);
    const auto& odd = bench.drain(bank1);
    sc_core::sc_start();
    ASSERT_EQ(odd.size(), 3U); // rows 1 and 3 belong to bank 1, and the end
    EXPECT_EQ(odd[0].first, 20U + 6);
    EXPECT_EQ(odd[1].first, 20U + 2 * 3 + 6);
    EXPECT_EQ(odd[0].second.span->length, 8);
    EXPECT_FALSE(odd[2].second.span);
    ASSERT_EQ(even.size(), 1U);
    EXPECT_FALSE(even[0].second.span);
    EXPECT_EQ(unit.stats().rows, 3U);
    EXPECT_EQ(unit.stats().empty_rows, 1U);
    EXPECT_EQ(unit.stats().tasks, 16U);
    EXPECT_EQ(unit.stats().busy, 9U);
}

/// A Tile Monitor of two slices and two tiles. Reports take 4 cycles to it, a cancellation 8 from
/// it.
struct MonitorBench {
    /// A slice reports a tile at `date`; `ended`: all its pixels have ended.
    struct Report {
        Cycle date;
        TileNumber tile;
        bool ended;
    };
    UnitBench bench{make_frame({blanket(16, 8, 64)}, 32, 16, 16)};
    TileMonitor unit{"unit", {}, bench.time, bench.job, 2, 1};
    DatedFifo<SliceReport> slice0{"slice0", bench.time, 4, 4};
    DatedFifo<SliceReport> slice1{"slice1", bench.time, 4, 4};
    DatedFifo<TileNumber> out{"out", bench.time, 4, 8};

    MonitorBench() {
        unit.in[0].bind(slice0);
        unit.in[1].bind(slice1);
        unit.out[0].bind(out);
    }
    void feed(DatedFifo<SliceReport>& slice, const std::vector<Report>& reports) {
        bench.script([&slice, reports](Process& self) {
            slice.connect_writer(self);
            for (const Report& report : reports) {
                self.advance_to(report.date);
                slice.put(self, {report.tile, report.ended});
            }
        });
    }
    /// Tile 1 is cancelled, and nothing else, when its last report at `date` has gone both ways.
    void expect_tile_1_cancelled(Cycle date) {
        const auto& got = bench.drain(out);
        sc_core::sc_start();
        ASSERT_EQ(got.size(), 1U);
        EXPECT_EQ(got[0].second, 1U);
        EXPECT_EQ(got[0].first, date + 4 + 8);
        EXPECT_EQ(unit.stats().tiles, 2U);
        EXPECT_EQ(unit.stats().tiles_cancelled, 1U);
    }
};

// Slice 1 still has live pixels of tile 0.
TEST(TileMonitor, CancelsWhenTheLastSliceHasReported) {
    MonitorBench monitor;
    monitor.feed(monitor.slice0, {{30, 0, true}, {40, 1, true}});
    monitor.feed(monitor.slice1, {{50, 0, false}, {60, 1, true}});
    monitor.expect_tile_1_cancelled(60);
}

// The live pixels of tile 0 are those of the slice that is asked first.
TEST(TileMonitor, LivePixelsOfAnySliceKeepATile) {
    MonitorBench monitor;
    monitor.feed(monitor.slice0, {{30, 0, false}, {40, 1, true}});
    monitor.feed(monitor.slice1, {{50, 0, true}, {60, 1, true}});
    monitor.expect_tile_1_cancelled(60);
}

// A slice may end a tile before an older one. Slice 0 has ended all of tile 0 and then of tile 1,
// slice 1 all of tile 1 and later, with live pixels, tile 0: only tile 1 is over everywhere.
TEST(TileMonitor, TakesReportsInAnyOrder) {
    MonitorBench monitor;
    monitor.feed(monitor.slice0, {{30, 0, true}, {40, 1, true}});
    monitor.feed(monitor.slice1, {{30, 1, true}, {40, 0, false}});
    monitor.expect_tile_1_cancelled(40);
}

/// Span Units that share lanes, with a bank's queue of their Span Vectors for every stream.
struct PoolBench {
    UnitBench bench;
    SpanPool unit;
    std::vector<std::unique_ptr<DatedFifo<RowItem>>> lanes;
    std::vector<std::unique_ptr<DatedFifo<SpanItem>>> queues;

    PoolBench(const SpanStage::Config& config, const SpanPool::Share& share, int depth)
        : bench(make_frame({blanket(16, 8, 64)}, 32, 16, 16)), // two tiles
          unit("unit", config, bench.time, bench.job, share) {
        for (auto& port : unit.in) {
            lanes.push_back(std::make_unique<DatedFifo<RowItem>>(
                ("lane" + std::to_string(lanes.size())).c_str(), bench.time, 64));
            port.bind(*lanes.back());
        }
        for (auto& port : unit.out) {
            queues.push_back(std::make_unique<DatedFifo<SpanItem>>(
                ("queue" + std::to_string(queues.size())).c_str(), bench.time, depth,
                config.latency_cycles, 1));
            port.bind(*queues.back());
        }
    }
    /// Rows 0 to rows - 1 of tiles into a lane, all there at 10, each with the end of its tile.
    void feed(std::size_t lane, const std::vector<std::pair<TileNumber, int>>& tiles) {
        bench.script([this, lane, tiles](Process& self) {
            lanes[lane]->connect_writer(self);
            self.advance(9);
            for (const auto& [tile, rows] : tiles) {
                for (int row = 0; row <= rows; ++row) {
                    RowItem item;
                    item.tile = tile;
                    item.row = static_cast<std::int16_t>(row);
                    item.end = row == rows;
                    lanes[lane]->put(self, item);
                }
            }
        });
    }
    /// The cycles from 10 on at which rows were taken, by what came out.
    static std::vector<Cycle> taken(const std::vector<std::pair<Cycle, SpanItem>>& got,
                                    int latency) {
        std::vector<Cycle> dates;
        for (const auto& [date, item] : got) {
            if (item.span) {
                dates.push_back(date - latency - 10);
            }
        }
        return dates;
    }
};

// Three units take three rows per cycle, whatever rows these are.
TEST(SpanPool, AnyFreeUnitTakesARow) {
    SpanStage::Config config;
    config.count = 3;
    config.rows = RowAssignment::Pool;
    SpanPool::Share share;
    share.units = 3;
    PoolBench pool(config, share, 64);
    pool.feed(0, {{0, 8}, {1, 0}});
    const auto& got = pool.bench.drain(*pool.queues[0]);
    sc_core::sc_start();
    EXPECT_EQ(PoolBench::taken(got, 6), (std::vector<Cycle>{0, 0, 0, 1, 1, 1, 2, 2}));
    EXPECT_EQ(pool.unit.stats().busy, 8U);
}

// A unit may take several rows per cycle, or need several cycles for a row.
class SpanPoolRates : public ::testing::TestWithParam<std::tuple<int, int, std::vector<Cycle>>> {};

TEST_P(SpanPoolRates, ARowPerIntervalOrSeveral) {
    const auto& [rows_per_cycle, cycles_per_row, dates] = GetParam();
    SpanStage::Config config;
    config.rows_per_cycle = rows_per_cycle;
    config.cycles_per_row = cycles_per_row;
    PoolBench pool(config, {}, 64);
    pool.feed(0, {{0, 5}, {1, 0}});
    const auto& got = pool.bench.drain(*pool.queues[0]);
    sc_core::sc_start();
    EXPECT_EQ(PoolBench::taken(got, 6), dates);
}

INSTANTIATE_TEST_SUITE_P(Rates, SpanPoolRates,
                         ::testing::Values(std::tuple(1, 1, std::vector<Cycle>{0, 1, 2, 3, 4}),
                                           std::tuple(2, 1, std::vector<Cycle>{0, 0, 1, 1, 2}),
                                           std::tuple(1, 3, std::vector<Cycle>{0, 3, 6, 9, 12})));

// Four units at one lane, which gives as many rows per cycle as it has ports.
class SpanPoolPorts : public ::testing::TestWithParam<std::pair<int, std::vector<Cycle>>> {};

TEST_P(SpanPoolPorts, LimitTheRowsOfALane) {
    SpanStage::Config config;
    config.count = 4;
    config.rows = RowAssignment::Pool;
    config.row_ports.ports = GetParam().first;
    SpanPool::Share share;
    share.units = 4;
    PoolBench pool(config, share, 64);
    pool.feed(0, {{0, 4}, {1, 0}});
    const auto& got = pool.bench.drain(*pool.queues[0]);
    sc_core::sc_start();
    EXPECT_EQ(PoolBench::taken(got, 6), GetParam().second);
}

INSTANTIATE_TEST_SUITE_P(Ports, SpanPoolPorts,
                         ::testing::Values(std::pair(0, std::vector<Cycle>{0, 0, 0, 0}),
                                           std::pair(2, std::vector<Cycle>{0, 0, 1, 1}),
                                           std::pair(1, std::vector<Cycle>{0, 1, 2, 3})));

// A unit serves its streams in turn, and alone the one that has something left.
TEST(SpanPool, StreamsTakeTurns) {
    SpanPool::Share share;
    share.streams = 2;
    PoolBench pool({}, share, 64);
    pool.feed(0, {{0, 3}});
    pool.feed(1, {{1, 5}});
    const auto& first = pool.bench.drain(*pool.queues[0]);
    const auto& second = pool.bench.drain(*pool.queues[1]);
    sc_core::sc_start();
    EXPECT_EQ(PoolBench::taken(first, 6), (std::vector<Cycle>{0, 2, 4}));
    EXPECT_EQ(PoolBench::taken(second, 6), (std::vector<Cycle>{1, 3, 5, 6, 7}));
    EXPECT_FALSE(first.back().second.span); // the ends of the tiles
    EXPECT_FALSE(second.back().second.span);
}

// Queues of two cells, those of the pipeline included. Stream 0's is not read before 40, and its
// third row waits for the cycle after, the end of the tile for one more. Stream 1's is read as soon
// as a Span Vector has come, six cycles after its row; it goes on in the cycle after.
TEST(SpanPool, AFullQueueHoldsUpItsStreamOnly) {
    SpanPool::Share share;
    share.streams = 2;
    PoolBench pool({}, share, 2);
    pool.feed(0, {{0, 3}});
    pool.feed(1, {{1, 4}});
    std::vector<Cycle> dates;
    pool.bench.script([&](Process& self) {
        pool.queues[0]->connect_reader(self);
        self.advance(40);
        while (dates.size() < 4) {
            pool.queues[0]->get(self);
            dates.push_back(self.local());
        }
    });
    const auto& second = pool.bench.drain(*pool.queues[1]);
    sc_core::sc_start();
    EXPECT_EQ(dates, (std::vector<Cycle>{40, 40, 41 + 6, 42 + 6}));
    EXPECT_EQ(PoolBench::taken(second, 6), (std::vector<Cycle>{1, 3, 1 + 7, 3 + 7}));
}

// A tile is read out at readout_pixels per cycle; its context is free then.
TEST(PixelBuffer, ContextsComeBackAfterTheReadout) {
    UnitBench bench(make_frame({blanket(24, 8, 64)}, 48, 13, 16)); // three tiles of 16 x 13
    PixelBuffer::Config config;
    config.readout_pixels = 10;
    PixelBuffer unit("unit", config, {}, bench.time, bench.job, 2, 1, PixelBuffer::Share{});
    DatedFifo<SliceReport> slice0("slice0", bench.time, 4, 4);
    DatedFifo<SliceReport> slice1("slice1", bench.time, 4, 4);
    DatedFifo<TileNumber> free0("free0", bench.time, 4, 1);
    DatedFifo<TileNumber> free1("free1", bench.time, 4, 1);
    unit.in[0].bind(slice0);
    unit.in[1].bind(slice1);
    unit.context_free[0].bind(free0);
    unit.context_free[1].bind(free1);
    bench.connect({&unit.frame_buffer}, 50);
    for (auto* ring : {&slice0, &slice1}) {
        bench.script([ring, &slice1](Process& self) {
            ring->connect_writer(self);
            for (TileNumber tile = 0; tile < 3; ++tile) {
                self.advance(ring == &slice1 ? 100 : 80);
                ring->put(self, {tile, false});
            }
        });
    }
    const auto& got = bench.drain(free0);
    const auto& other = bench.drain(free1);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 2U);
    constexpr Cycle kReadout = (16 * 13 + 9) / 10;
    for (Cycle tile = 0; tile < 2; ++tile) {
        EXPECT_EQ(got[tile].first, 100 * (tile + 1) + 4 + kReadout + 1);
        EXPECT_EQ(got[tile].second, tile + 1);
        EXPECT_EQ(other[tile].first, got[tile].first);
    }
    EXPECT_EQ(unit.stats().readout_busy, 3 * kReadout);
    EXPECT_EQ(unit.stats().tiles, 3U);
    EXPECT_GE(unit.stats().finished, 300U + 4 + 50);
    EXPECT_EQ(bench.memory->total().bytes_written, 3U * 16 * 13 * 4);
}

class TileWrites : public ::testing::TestWithParam<int> {};

// Four tiles of 16 x 16 px are complete at once, are read out in 16 cycles each, and memory answers
// after 100 more. A tile is not read out before the write `writes` before it has been answered.
TEST_P(TileWrites, LimitTheReadout) {
    UnitBench bench(make_frame({blanket(32, 8, 64)}, 64, 16, 16), 4);
    PixelBuffer::Config config;
    config.readout_pixels = 16;
    config.writes_in_flight = GetParam();
    PixelBuffer unit("unit", config, {}, bench.time, bench.job, 1, 4, PixelBuffer::Share{});
    DatedFifo<SliceReport> slice("slice", bench.time, 8);
    DatedFifo<TileNumber> free("free", bench.time, 8);
    unit.in[0].bind(slice);
    unit.context_free[0].bind(free);
    bench.connect({&unit.frame_buffer}, 100);
    bench.script([&](Process& self) {
        slice.connect_writer(self);
        self.advance(9);
        for (TileNumber tile = 0; tile < 4; ++tile) {
            slice.put(self, {tile, false});
        }
    });
    bench.drain(free);
    sc_core::sc_start();
    std::vector<Cycle> begun, answered;
    Cycle ready = 10, waited = 0;
    for (int tile = 0; tile < 4; ++tile) {
        Cycle begin = ready;
        if (tile >= GetParam()) {
            begin = std::max(begin, answered[tile - GetParam()]);
        }
        waited += begin - ready;
        answered.push_back(begin + 15 + 100); // the last row leaves in the last cycle
        ready = begin + 16;
    }
    EXPECT_EQ(unit.stats().write_wait, waited);
    EXPECT_EQ(unit.stats().finished, answered.back());
    EXPECT_EQ(unit.stats().readout_busy, 4U * 16);
}

INSTANTIATE_TEST_SUITE_P(Writes, TileWrites, ::testing::Values(1, 2, 3, 4));

} // namespace
} // namespace degs
