// SPDX-License-Identifier: Apache-2.0
// Projection Unit, Tile Binner and Sorting Unit, one at a time: dates against closed formulas.
// Memory is ideal (no latency, no transfer time) unless a test says otherwise.
#include "modules/kit/front_end/projection_unit.hpp"
#include "modules/kit/front_end/sorting_unit.hpp"
#include "modules/kit/front_end/splat_fetcher.hpp"
#include "modules/kit/front_end/tile_binner.hpp"
#include "tests/modules/kit/job/unit_bench.hpp"
#include "tlm/memory.hpp"

namespace degs {
namespace {

using test::one_pixel_splats;
using test::UnitBench;

// Chunk k is read at k, projected in 10 cycles behind its predecessor, 32 cycles deep, then shaded
// at 3 cycles per splat.
TEST(ProjectionUnit, ThreeStepsOverlap) {
    UnitBench bench(one_pixel_splats(40));
    ProjectionUnit::Config config;
    config.count = 1;
    config.chunk = 10;
    config.cycles_per_colour = 3;
    ProjectionUnit unit("unit", config, {}, bench.time, bench.job, 0);
    DatedFifo<ProjectedChunk> out("out", bench.time, 8);
    unit.out.bind(out);
    bench.connect({&unit.geometry, &unit.sh});
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 4U);
    for (Cycle k = 0; k < 4; ++k) {
        EXPECT_EQ(got[k].second.visible, 10U);
        EXPECT_EQ(got[k].second.first_visible, 10U * k);
        EXPECT_EQ(got[k].second.tile_pairs, 10U);
        // The read takes a cycle (1), each chunk 10 cycles, the pipeline 32, shading 30 per chunk.
        EXPECT_EQ(got[k].first, 1U + 10 + 32 + 30 * (k + 1) + 1) << k;
    }
    EXPECT_EQ(unit.stats().project_busy, 40U);
    EXPECT_EQ(unit.stats().shade_busy, 120U);
    EXPECT_EQ(unit.stats().visible, 40U);
}

// pairs / rate cycles per chunk, at least one; lists are complete when their last write is.
TEST(TileBinner, AFrameIsBinnedWhenItsListsAreInMemory) {
    UnitBench bench(one_pixel_splats(50));
    TileBinner::Config config;
    config.pairs_per_cycle = 4;
    ListChanges changes(bench.job, false);
    TileBinner unit("unit", config, {}, bench.time, bench.job, changes, 10, 1, 1);
    DatedFifo<ProjectedChunk> in("in", bench.time, 8);
    DatedFifo<std::uint32_t> out("out", bench.time, 8);
    unit.in[0].bind(in);
    unit.out[0].bind(out);
    bench.connect({&unit.splats, &unit.lists}, 200);
    bench.script([&](Process& self) {
        in.connect_writer(self);
        for (std::uint32_t k = 0; k < 5; ++k) {
            ProjectedChunk chunk;
            chunk.first_visible = 10 * k;
            chunk.visible = 10;
            chunk.tile_pairs = 10;
            in.put(self, chunk);
        }
    });
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 1U);
    EXPECT_EQ(unit.stats().busy, 5U * 3);
    // 1 + 15 cycles, two writes of one port each; the second starts within a cycle of the first.
    EXPECT_GE(unit.stats().frame_binned, 16U + 200);
    EXPECT_LE(unit.stats().frame_binned, 16U + 200 + 2);
    EXPECT_EQ(got[0].first, unit.stats().frame_binned + 1);
    EXPECT_EQ(bench.memory->stats(0).bytes_written, 5U * 10 * 32);
    EXPECT_EQ(bench.memory->stats(1).bytes_written, 5U * 2 * 64); // 80 B touch two granules each
}

/// A Sorting Unit with the Splat Fetcher behind it.
struct SortAndFetch {
    ListChanges changes;
    SortingUnit sorter;
    SplatFetcher fetcher;
    DatedFifo<std::uint32_t> start;
    DatedFifo<SortedRun> sorted;
    DatedFifo<TileNumber> cancel;
    DatedFifo<SplatChunk> out;

    SortAndFetch(UnitBench& bench, const SortingUnit::Config& config, std::uint64_t capacity)
        : changes(bench.job, false),
          sorter("sorter", config, {}, bench.time, bench.job, changes, 0, capacity),
          fetcher("fetcher", {}, {}, bench.time, bench.job, 1, false),
          start("start", bench.time, 1), sorted("sorted", bench.time, 1),
          cancel("cancel", bench.time, 4, 8), out("out", bench.time, 64) {
        sorter.start.bind(start);
        sorter.sorted.bind(sorted);
        fetcher.sorted.bind(sorted);
        fetcher.cancel.bind(cancel);
        fetcher.out[0].bind(out);
        bench.connect({&sorter.loader.lists, &sorter.lists, &fetcher.records});
        bench.script([this](Process& self) {
            start.connect_writer(self);
            self.advance(99);
            start.put(self, 0);
        });
        bench.script([this](Process& self) { cancel.connect_writer(self); });
    }
};

struct MergeSortCase {
    int keys, ways, rate, passes;
};
std::ostream& operator<<(std::ostream& out, const MergeSortCase& c) {
    return out << c.keys << "_keys_" << c.ways << "_ways_" << c.rate << "_per_cycle";
}
class Sorting : public ::testing::TestWithParam<MergeSortCase> {};

// Load 1 cycle, ceil(keys x passes / rate) cycles of merging, then a chunk of records per two
// cycles (one for the question whether the tile is cancelled).
TEST_P(Sorting, MergePassesOverTheRate) {
    const MergeSortCase& c = GetParam();
    UnitBench bench(one_pixel_splats(c.keys));
    SortingUnit::Config config;
    config.count = 1;
    config.keys_per_cycle = c.rate;
    config.merge_ways = c.ways;
    SortAndFetch units(bench, config, 1U << 20U);
    const SortingUnit& unit = units.sorter;
    const auto& got = bench.drain(units.out);
    sc_core::sc_start();
    const auto merging = static_cast<Cycle>((c.keys * c.passes + c.rate - 1) / c.rate);
    EXPECT_EQ(unit.stats().sort_busy, merging);
    EXPECT_EQ(unit.stats().memory_passes, 0U);
    ASSERT_EQ(got.size(), static_cast<std::size_t>((c.keys + 15) / 16));
    for (Cycle k = 0; k < got.size(); ++k) {
        // Start at 100, list there at 101, sorted and handed on, asked, read, handed over.
        EXPECT_EQ(got[k].first, 101 + merging + 1 + 2 * k + 2) << k;
        EXPECT_EQ(got[k].second.last, k + 1 == got.size());
    }
}

INSTANTIATE_TEST_SUITE_P(Lists, Sorting,
                         ::testing::Values(MergeSortCase{1, 16, 4, 1}, MergeSortCase{16, 16, 4, 1},
                                           MergeSortCase{17, 16, 4, 2}, MergeSortCase{100, 2, 3, 7},
                                           MergeSortCase{200, 16, 8, 2}));

// Lists longer than the buffer: ceil(log_ways runs) more passes, each writing and reading all.
TEST(SortingUnit, LongListsTakeExtraPassesThroughMemory) {
    UnitBench bench(one_pixel_splats(200));
    SortingUnit::Config config;
    config.count = 1;
    config.merge_ways = 2;
    SortAndFetch units(bench, config, 50);
    const SortingUnit& unit = units.sorter;
    const auto& got = bench.drain(units.out);
    sc_core::sc_start();
    EXPECT_EQ(got.size(), 13U);
    EXPECT_EQ(unit.stats().memory_passes, 2U); // 4 runs of 50, two ways
    // In the buffer 6 passes of 50 keys, then 2 of all, 4 keys per cycle.
    EXPECT_EQ(unit.stats().sort_busy, 200U * 6 / 4 + 2 * 200 / 4);
    EXPECT_EQ(bench.memory->stats(0).bytes_read, 200U * 8);
    EXPECT_EQ(bench.memory->stats(1).bytes_read, 2U * 200 * 8);
    EXPECT_EQ(bench.memory->stats(1).bytes_written, 2U * 200 * 8);
}

// Two passes of every list, although it fits.
TEST(SortingUnit, ListsTakeTheirLeastPassesThroughMemory) {
    UnitBench bench(one_pixel_splats(40));
    SortingUnit::Config config;
    config.count = 1;
    config.memory_passes = 2;
    SortAndFetch units(bench, config, 1000);
    bench.drain(units.out);
    sc_core::sc_start();
    EXPECT_EQ(units.sorter.stats().memory_passes, 2U);
    EXPECT_EQ(units.sorter.stats().sort_busy, 40U * 2 / 4 + 2 * 40 / 4);
    EXPECT_EQ(bench.memory->stats(1).bytes_read, 2U * 40 * 8);
    EXPECT_EQ(bench.memory->stats(1).bytes_written, 2U * 40 * 8);
}

/// Forty Gaussians of a pixel each, the first `left` of them in the left of two tiles.
FrameWorkload two_tiles(int left) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 40; ++i) {
        splats.push_back(test::one_pixel(i % 8 + (i < left ? 0 : 16), i / 8));
    }
    return test::make_frame(splats, 32, 16, 16);
}

// Thirty and ten keys; in the second frame all forty are in the left tile. Ten of them are new, are
// sorted alone and merged with the list that was kept; each sorted list goes back to memory.
TEST(SortingUnit, KeptListsAreMergedWithNewKeys) {
    UnitBench bench(two_tiles(30));
    const FrameWorkload second = two_tiles(40);
    bench.job.add(borrowed(second));
    ListChanges changes(bench.job, true);
    SortingUnit::Config config;
    config.count = 1;
    SortingUnit unit("unit", config, {}, bench.time, bench.job, changes, 0, 1000);
    DatedFifo<std::uint32_t> start("start", bench.time, 2);
    DatedFifo<SortedRun> sorted("sorted", bench.time, 8);
    unit.start.bind(start);
    unit.sorted.bind(sorted);
    bench.connect({&unit.loader.lists, &unit.lists});
    bench.script([&](Process& self) {
        start.connect_writer(self);
        start.put(self, 0);
        start.put(self, 1);
    });
    bench.drain(sorted);
    sc_core::sc_start();
    // Two passes of 30 keys and one of 10; one pass of 10 and a merge of 40. Four keys per cycle.
    EXPECT_EQ(unit.stats().sort_busy, 60U / 4 + 3 + (10 + 40 + 3) / 4);
    // Entries 0 .. 29 of 8 B are in four granules, 30 .. 39 in two, 0 .. 39 in five.
    EXPECT_EQ(bench.memory->stats(1).bytes_written, (4U + 2 + 5) * 64);
}

/// A Tile Binner that writes the entries of `frame` by tile, fed with one chunk of all of it.
struct EntriesBench {
    UnitBench bench;
    ListChanges changes{bench.job, false};
    TileBinner unit;
    DatedFifo<ProjectedChunk> in{"in", bench.time, 1};
    DatedFifo<std::uint32_t> out{"out", bench.time, 1};

    EntriesBench(FrameWorkload frame, const TileBinner::Config& config)
        : bench(std::move(frame)),
          unit("unit", config, {}, bench.time, bench.job, changes, 64, 1, 1) {
        unit.in[0].bind(in);
        unit.out[0].bind(out);
        bench.connect({&unit.splats, &unit.lists, unit.heads.get()});
        bench.script([this](Process& self) {
            in.connect_writer(self);
            ProjectedChunk chunk;
            chunk.visible = static_cast<std::uint32_t>(bench.frame.splats.size());
            chunk.tile_pairs = static_cast<std::uint32_t>(bench.frame.tile_pairs());
            in.put(self, chunk);
        });
        bench.drain(out);
        sc_core::sc_start();
    }
};

// The end of the first list is on the chip: 30 entries read and write its 4 B. The other ten go to
// memory for the end of theirs.
TEST(TileBinner, EndsOfListsFarAwayAreNotInItsSram) {
    TileBinner::Config config;
    config.entries = ListWriting::Entries;
    config.head_bytes = 4;
    const EntriesBench entries(two_tiles(30), config);
    EXPECT_EQ(entries.unit.stats().groups, 40U);
    EXPECT_EQ(entries.unit.stats().far_heads, 10U);
    EXPECT_EQ(entries.unit.sram_bytes_moved(), 2U * 30 * 4);
    EXPECT_EQ(entries.bench.memory->stats(2).bytes_read, 10U * 64);
}

class HalfBuffers : public ::testing::TestWithParam<int> {};

// Half of the buffer holds four entries of 8 B: five leave in two groups.
TEST_P(HalfBuffers, LeaveWhenTheyAreFull) {
    TileBinner::Config config;
    config.entries = ListWriting::Combined;
    config.buffer_bytes = 64;
    const EntriesBench entries(one_pixel_splats(GetParam()), config);
    EXPECT_EQ(entries.unit.stats().groups, static_cast<std::uint64_t>((GetParam() + 3) / 4));
    EXPECT_EQ(entries.unit.stats().entries, static_cast<std::uint64_t>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Entries, HalfBuffers, ::testing::Values(4, 5, 8, 9));

} // namespace
} // namespace degs
