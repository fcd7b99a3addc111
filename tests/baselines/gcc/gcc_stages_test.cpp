// SPDX-License-Identifier: Apache-2.0
// Stages I to III of GCC, one at a time: dates against closed formulas. Memory is ideal (no
// latency, no transfer time) unless a test says otherwise.
#include "baselines/gcc/colour_stage.hpp"
#include "baselines/gcc/grouping.hpp"
#include "baselines/gcc/projection_stage.hpp"
#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::make_frame;
using test::one_pixel;
using Bench = test::UnitBench;

/// `count` one-pixel splats on one view of 64 px, from left to right in its first 8 rows.
FrameWorkload many_splats(int count) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < count; ++i) {
        splats.push_back(one_pixel(i * 64 / count, i % 8));
    }
    return make_frame(splats, 64, 64, 64);
}

// A chunk of 100 means takes 100 / 4 cycles; the lists are complete when the last write is.
TEST(GccGrouping, AFrameIsGroupedWhenItsListsAreInMemory) {
    Bench bench(many_splats(500));
    gcc::Grouping::Config config;
    config.chunk = 100;
    gcc::Grouping unit("unit", config, {}, bench.time, bench.job, 0);
    DatedFifo<std::uint32_t> out("out", bench.time, 4);
    unit.out[0].bind(out);
    bench.connect({&unit.means, &unit.lists}, 200);
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 1U);
    EXPECT_EQ(unit.stats().busy, 5U * 25);
    EXPECT_EQ(unit.stats().gaussians, 500U);
    EXPECT_EQ(unit.stats().entries_written, 500U);
    // Means of four chunks at 200; the fifth is asked for when the first is taken, so it
    // is there at 400, takes 25 cycles, and its entries are in memory 200 later. An
    // access takes a cycle or so.
    EXPECT_GE(unit.frames_grouped()[0], 400U + 25 + 200);
    EXPECT_LE(unit.frames_grouped()[0], 400U + 25 + 200 + 2);
    EXPECT_EQ(got[0].first, unit.frames_grouped()[0] + 1);
    EXPECT_EQ(bench.memory->stats(0).bytes_read, 5U * 13 * 64); // 800 B touch 13 granules
}

// 8 entries per cycle limit where a Gaussian overlaps many views.
TEST(GccGrouping, EntriesLimitWhereSplatsAreLarge) {
    Bench bench(make_frame(std::vector<ProjectedSplat>(100, blanket(64, 64, 80, 0.01)), 128, 128,
                           16)); // 64 views each
    gcc::Grouping unit("unit", {}, {}, bench.time, bench.job, 0);
    DatedFifo<std::uint32_t> out("out", bench.time, 4);
    unit.out[0].bind(out);
    bench.connect({&unit.means, &unit.lists});
    bench.drain(out);
    sc_core::sc_start();
    EXPECT_EQ(unit.stats().busy, 100U * 64 / 8);
    EXPECT_EQ(unit.stats().view_entries, 6400U);
}

// Two passes: groups of the image are read back before the views' lists are written.
TEST(GccGrouping, RegroupingReadsAndWritesAgain) {
    Bench bench(make_frame(std::vector<ProjectedSplat>(100, blanket(64, 64, 80, 0.01)), 128, 128,
                           64)); // 4 views each
    gcc::Grouping::Config config;
    config.lists = gcc::Lists::Regrouped;
    config.chunk = 10;
    gcc::Grouping unit("unit", config, {}, bench.time, bench.job, 0);
    DatedFifo<std::uint32_t> out("out", bench.time, 4);
    unit.out[0].bind(out);
    bench.connect({&unit.means, &unit.lists});
    bench.drain(out);
    sc_core::sc_start();
    EXPECT_EQ(unit.stats().entries_written, 100U + 400);
    EXPECT_EQ(unit.stats().busy, 10U * 3 + 10 * 5); // ceil(10 / 4) and 40 / 8 per chunk
}

struct StageBench : Bench {
    using Bench::Bench;
    DatedFifo<TileNumber> cancel_a{"cancel_a", time, 4, 8}, cancel_b{"cancel_b", time, 4, 8};
    /// Cancels view 0 at a date, or never.
    void cancel_at(Cycle date) {
        script([this, date](Process& self) {
            cancel_a.connect_writer(self);
            cancel_b.connect_writer(self);
            if (date != kNever) {
                self.advance_to(date);
                cancel_a.put(self, 0);
                cancel_b.put(self, 0);
            }
        });
    }
};

// Loaded 1 cycle after the start, asked, read: group k is loaded at 2 + k, its shapes are read a
// cycle later each step; projection takes 256 / 4 cycles per group and 32 more.
TEST(GccProjectionStage, GroupsFollowEachOther) {
    StageBench bench(many_splats(1000));
    gcc::ProjectionStage::Config config;
    config.group = 200;
    gcc::ProjectionStage unit("unit", config, {}, bench.time, bench.job);
    DatedFifo<std::uint32_t> start("start", bench.time, 1);
    DatedFifo<SplatChunk> out("out", bench.time, 8, 32);
    unit.start.bind(start);
    unit.cancel[0].bind(bench.cancel_a);
    unit.cancel[1].bind(bench.cancel_b);
    unit.out.bind(out);
    bench.connect({&unit.lists, &unit.shapes});
    bench.cancel_at(kNever);
    bench.script([&](Process& self) {
        start.connect_writer(self);
        self.advance(99);
        start.put(self, 0);
    });
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 5U);
    for (Cycle k = 0; k < 5; ++k) {
        // Start at 100; asked and in the ring at 102; asked again and fetched at 104.
        EXPECT_EQ(got[k].first, 104 + 50 * (k + 1) + 32) << k;
        EXPECT_EQ(got[k].second.first, 200 * k);
        EXPECT_EQ(got[k].second.count, 200U);
        EXPECT_EQ(got[k].second.last, k == 4);
    }
    EXPECT_EQ(unit.stats().busy, 250U);
    EXPECT_EQ(bench.memory->stats(1).bytes_read, 1000U * 64); // a burst each, wherever they lie
}

// Cancelled in the middle: one empty group says that the view is over.
TEST(GccProjectionStage, ACancelledViewEndsWithAnEmptyGroup) {
    StageBench bench(many_splats(2000));
    gcc::ProjectionStage::Config config;
    config.group = 100;
    gcc::ProjectionStage unit("unit", config, {}, bench.time, bench.job);
    DatedFifo<std::uint32_t> start("start", bench.time, 1);
    DatedFifo<SplatChunk> out("out", bench.time, 8, 32);
    unit.start.bind(start);
    unit.cancel[0].bind(bench.cancel_a);
    unit.cancel[1].bind(bench.cancel_b);
    unit.out.bind(out);
    bench.connect({&unit.lists, &unit.shapes});
    bench.cancel_at(200);
    bench.script([&](Process& self) {
        start.connect_writer(self);
        start.put(self, 0);
    });
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    ASSERT_FALSE(got.empty());
    EXPECT_TRUE(got.back().second.last);
    EXPECT_EQ(got.back().second.count, 0U);
    const gcc::ProjectionStage::Stats& s = unit.stats();
    EXPECT_EQ(s.entries + s.entries_cancelled, 2000U);
    EXPECT_EQ(s.entries, s.shapes + s.shapes_cancelled);
    EXPECT_GT(s.shapes, 700U); // 25 cycles per group: 8 of them until 208
    EXPECT_LT(s.shapes, 1200U);
}

struct ColourCase {
    int count, units, rate, ways, passes;
};
std::ostream& operator<<(std::ostream& out, const ColourCase& c) {
    return out << c.count << "_keys_" << c.ways << "_ways";
}
class GccColour : public ::testing::TestWithParam<ColourCase> {};

// A group leaves max(ceil(n / units), ceil(n passes / rate)) cycles after its SH is there.
TEST_P(GccColour, ColoursAndSortingOverlap) {
    const ColourCase& c = GetParam();
    StageBench bench(many_splats(c.count));
    gcc::ColourStage::Config config;
    config.units = c.units;
    config.keys_per_cycle = c.rate;
    config.merge_ways = c.ways;
    gcc::ColourStage unit("unit", config, {}, bench.time, bench.job, 1);
    DatedFifo<SplatChunk> in("in", bench.time, 1), out("out", bench.time, 64);
    DatedFifo<gcc::BlockEnded> blocks("blocks", bench.time, 64, 8);
    unit.in.bind(in);
    unit.out.bind(out);
    unit.cancel.bind(bench.cancel_a);
    unit.block_ended[0].bind(blocks);
    bench.connect({&unit.sh});
    bench.script([&](Process& self) {
        in.connect_writer(self);
        self.advance(99);
        in.put(self, {0, 0, static_cast<std::uint32_t>(c.count), true});
    });
    bench.script([&](Process& self) { blocks.connect_writer(self); });
    bench.script([&](Process& self) { bench.cancel_a.connect_writer(self); });
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    const auto colour = static_cast<Cycle>((c.count + c.units - 1) / c.units);
    const auto sort = static_cast<Cycle>((c.count * c.passes + c.rate - 1) / c.rate);
    EXPECT_EQ(unit.stats().colour_busy, colour);
    EXPECT_EQ(unit.stats().sort_busy, sort);
    ASSERT_EQ(got.size(), static_cast<std::size_t>((c.count + 15) / 16));
    for (std::size_t i = 0; i < got.size(); ++i) {
        // Group at 100, asked, SH at 102, and a cycle to the array.
        EXPECT_EQ(got[i].first, 102 + std::max(colour, sort) + 1);
        EXPECT_EQ(got[i].second.last, i + 1 == got.size());
        EXPECT_EQ(got[i].second.first, 16 * i);
    }
}

INSTANTIATE_TEST_SUITE_P(Groups, GccColour,
                         ::testing::Values(ColourCase{256, 4, 4, 16, 2},
                                           ColourCase{17, 1, 4, 16, 2}, ColourCase{16, 4, 4, 16, 1},
                                           ColourCase{1, 4, 4, 16, 1},
                                           ColourCase{100, 4, 8, 2, 7}));

// Blocks 0..3 of the row of blocks have ended when the second group enters, not the first. Splats
// of block 3 whose boxes, a pixel wider, reach block 4 stay.
TEST(GccColourStage, TheMaskIsReadWhenAGroupEnters) {
    StageBench bench(many_splats(64)); // pixel i in column i
    gcc::ColourStage unit("unit", {}, {}, bench.time, bench.job, 1);
    DatedFifo<SplatChunk> in("in", bench.time, 1), out("out", bench.time, 64);
    DatedFifo<gcc::BlockEnded> blocks("blocks", bench.time, 64, 8);
    unit.in.bind(in);
    unit.out.bind(out);
    unit.cancel.bind(bench.cancel_a);
    unit.block_ended[0].bind(blocks);
    bench.connect({&unit.sh});
    bench.script([&](Process& self) {
        in.connect_writer(self);
        in.put(self, {0, 0, 16, false});
        self.advance(100);
        in.put(self, {0, 16, 48, true});
    });
    bench.script([&](Process& self) {
        blocks.connect_writer(self);
        self.advance(50);
        for (std::int16_t column = 0; column < 4; ++column) {
            for (const std::int16_t row : {std::int16_t{0}, std::int16_t{1}}) {
                blocks.put(self, {0, row, column});
            }
        }
    });
    bench.script([&](Process& self) { bench.cancel_a.connect_writer(self); });
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    const gcc::ColourStage::Stats& s = unit.stats();
    EXPECT_EQ(s.coloured + s.masked, 64U);
    EXPECT_GE(s.masked, 13U); // columns 16..28
    EXPECT_LE(s.masked, 16U); // columns 16..31
    std::uint64_t left = 0;
    for (const auto& [date, chunk] : got) {
        left += chunk.count;
    }
    EXPECT_EQ(left, s.coloured);
    EXPECT_EQ(got[0].second.count, 16U);
    EXPECT_EQ(got[1].second.first, 16 + s.masked);
}

} // namespace
} // namespace degs
