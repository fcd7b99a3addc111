// SPDX-License-Identifier: Apache-2.0
// Dates of the hierarchical sorter against closed formulas; memory is ideal.
#include "modules/kit/front_end/hierarchical_sorter.hpp"

#include "tests/modules/kit/job/unit_bench.hpp"
#include "tlm/memory.hpp"

namespace degs {
namespace {

using test::one_pixel_splats;
using test::UnitBench;

struct SorterBench {
    UnitBench bench;
    ListChanges changes;
    HierarchicalSorter sorter;
    DatedFifo<std::uint32_t> start;
    DatedFifo<SortedRun> sorted;
    DatedFifo<TileNumber> cancel;

    SorterBench(int keys, const HierarchicalSorter::Config& config, std::uint64_t capacity,
                std::size_t depth = 64, Cycle cancelled = kNever)
        : bench(one_pixel_splats(keys)), changes(bench.job, false),
          sorter("sorter", config, {}, bench.time, bench.job, changes, 0, capacity),
          start("start", bench.time, 1), sorted("sorted", bench.time, depth),
          cancel("cancel", bench.time, 4) {
        sorter.start.bind(start);
        sorter.sorted.bind(sorted);
        sorter.cancel.bind(cancel);
        bench.connect({&sorter.loader.lists, &sorter.lists, &sorter.chunks});
        bench.script([this](Process& self) {
            start.connect_writer(self);
            self.advance(99);
            start.put(self, 0);
        });
        bench.script([this, cancelled](Process& self) {
            cancel.connect_writer(self);
            if (cancelled != kNever) {
                self.advance(cancelled - 1);
                cancel.put(self, 0);
            }
        });
    }
};

HierarchicalSorter::Config small(int chunk) {
    HierarchicalSorter::Config config;
    config.count = 1;
    config.chunk = chunk;
    config.keys_per_cycle = 4;
    config.fine_cycles_per_key = 3;
    return config;
}

struct ChunkSortCase {
    int keys, chunk, levels;
};
std::ostream& operator<<(std::ostream& out, const ChunkSortCase& c) {
    return out << c.keys << "_by_" << c.chunk;
}
class HierarchicalSorting : public ::testing::TestWithParam<ChunkSortCase> {};

// Start at 100, list there at 101; ceil(log2(n / chunk)) levels of ceil(n / 4) cycles, then chunk
// after chunk, each a cycle for the question whether the tile is cancelled and 3 per key.
TEST_P(HierarchicalSorting, LevelsThenChunksOneAfterTheOther) {
    const ChunkSortCase& c = GetParam();
    SorterBench units(c.keys, small(c.chunk), 1U << 20U);
    const auto& got = units.bench.drain(units.sorted);
    sc_core::sc_start();
    const auto coarse = static_cast<Cycle>(c.levels * ((c.keys + 3) / 4));
    const auto chunks = static_cast<std::size_t>((c.keys + c.chunk - 1) / c.chunk);
    ASSERT_EQ(got.size(), chunks + 1);
    for (std::size_t k = 0; k < chunks; ++k) {
        const std::uint64_t end = std::min<std::uint64_t>(
            static_cast<std::uint64_t>(c.keys), (k + 1) * static_cast<std::uint64_t>(c.chunk));
        EXPECT_EQ(got[k].second.end, end);
        EXPECT_EQ(got[k].first, 101 + coarse + 1 + (k + 1) + 3 * end + 1) << k;
    }
    EXPECT_EQ(got.back().second.tile, kNoTile);
    EXPECT_EQ(units.sorter.stats().coarse_busy, coarse);
    EXPECT_EQ(units.sorter.stats().fine_busy, 3U * static_cast<Cycle>(c.keys));
    EXPECT_EQ(units.sorter.stats().memory_levels, 0U);
    EXPECT_EQ(units.bench.memory->stats(0).bytes_read,
              static_cast<std::uint64_t>((c.keys * 8 + 63) / 64 * 64));
}
INSTANTIATE_TEST_SUITE_P(Lists, HierarchicalSorting,
                         ::testing::Values(ChunkSortCase{1, 16, 0}, ChunkSortCase{16, 16, 0},
                                           ChunkSortCase{17, 16, 1}, ChunkSortCase{32, 16, 1},
                                           ChunkSortCase{33, 16, 2}, ChunkSortCase{200, 16, 4},
                                           ChunkSortCase{200, 256, 0}),
                         ::testing::PrintToStringParamName());

// 200 keys where 50 fit: two levels (100, 50) read and write everything, the last two
// happen in the buffer; the first level's read is the loader's, each of the 16 chunks of
// 12.5 .. 13 is read again.
TEST(HierarchicalSorter, LongListsGoThroughMemory) {
    SorterBench units(200, small(16), 50);
    units.bench.drain(units.sorted);
    sc_core::sc_start();
    const HierarchicalSorter::Stats& stats = units.sorter.stats();
    EXPECT_EQ(stats.memory_levels, 2U);
    EXPECT_EQ(stats.coarse_busy, 4U * 50);
    EXPECT_EQ(units.bench.memory->stats(0).bytes_read, 1600U);
    EXPECT_EQ(units.bench.memory->stats(1).bytes_written, 2U * 1600);
    EXPECT_EQ(units.bench.memory->stats(1).bytes_read, 1600U);
    EXPECT_EQ(units.bench.memory->stats(2).bytes_read, 1600U); // 12 x 128 B and 64 B
    EXPECT_EQ(stats.keys_sorted, 200U);
}

// Cancelled while the second of 13 chunks is sorted: the third is not any more.
TEST(HierarchicalSorter, ChunksOfACancelledTileAreNotSorted) {
    const Cycle first = 101 + 200 + 1; // coarse is over
    SorterBench units(200, small(16), 1U << 20U, 64, first + 49 + 20);
    const auto& got = units.bench.drain(units.sorted);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 4U);
    EXPECT_EQ(got[1].second.end, 32U);
    EXPECT_EQ(got[2].second.end, 200U); // the fetcher gets the end of the list
    EXPECT_EQ(units.sorter.stats().keys_sorted, 32U);
    EXPECT_EQ(units.sorter.stats().keys_cancelled, 168U);
}

// On demand: with a ring of one run, the sorter is two chunks ahead of a reader that takes none.
TEST(HierarchicalSorter, IsAheadByWhatTheRingHolds) {
    SorterBench units(200, small(16), 1U << 20U, 1);
    Cycle third = 0;
    units.bench.script([&](Process& self) {
        self.advance(5000);
        for (int run = 0; run < 14; ++run) {
            units.sorted.get(self);
            third = run == 2 ? self.local() : third;
        }
    });
    sc_core::sc_start();
    // The first run waits in the ring, the second in the unit until 5000; the third is sorted then.
    EXPECT_EQ(third, 5000U + 49 + 1);
}

} // namespace
} // namespace degs
