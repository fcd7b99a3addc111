// SPDX-License-Identifier: Apache-2.0
// Dates of one tile engine, from the rule: a splat per cycle, a pixel per cycle and Row
// PE. An entry pushed in cycle t is loaded in t + 1 at the earliest; an entry of n
// pixels takes n + 1 slots.
#include "tests/baselines/gbu/tile_engine_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::make_frame;
using test::one_pixel;
using test::one_row;
using test::small_engine;
using test::TileEngineBench;

std::vector<ProjectedSplat> many(std::size_t count, const ProjectedSplat& splat) {
    return std::vector<ProjectedSplat>(count, splat);
}

TEST(TileEngine, OneSplatOverTheWholeTile) {
    TileEngineBench bench(small_engine(), make_frame({blanket(8, 8, 20)}, 16, 16, 16));
    bench.run(bench.lists({0}));
    const Cycle load = bench.first_push() + 1;
    EXPECT_EQ(bench.stats().window.first, load);
    EXPECT_EQ(bench.stats().window.last, load + 16); // 16 pixels and the probe
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 256U);
    EXPECT_EQ(bench.stats().slots[Slot::Boundary], 16U);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 0U);
    EXPECT_EQ(bench.done(), load + 16 + 5);
    EXPECT_EQ(bench.units[0]->tile_state.at(0).first, load + 16 + 5);
    EXPECT_FALSE(bench.units[0]->tile_state.at(0).second.all_ended);
}

TEST(TileEngine, WithoutTheProbeAnEntryTakesItsPixels) {
    gbu::TileEngine::Config config = small_engine();
    config.end_probe = false;
    TileEngineBench bench(config, make_frame(many(3, blanket(8, 8, 20, 0.1)), 16, 16, 16));
    bench.run(bench.lists({0}));
    EXPECT_EQ(bench.stats().window.cycles(), 48U);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 48U * 16);
    EXPECT_EQ(bench.stats().slots.total(), 48U * 16);
}

TEST(TileEngine, OnePixelKeepsOnePeBusyForTwoSlots) {
    TileEngineBench bench(small_engine(), make_frame({one_pixel(15, 3)}, 16, 16, 16));
    bench.run(bench.lists({0}));
    EXPECT_EQ(bench.stats().window.cycles(), 2U); // also at the right edge
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 1U);
    EXPECT_EQ(bench.stats().slots[Slot::Boundary], 1U);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 30U);
}

TEST(TileEngine, OneRowLeavesTheOtherPesWithoutWork) {
    TileEngineBench bench(small_engine(), make_frame({one_row(2, 11, 7)}, 16, 16, 16));
    bench.run(bench.lists({0}));
    EXPECT_EQ(bench.stats().window.cycles(), 11U);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 10U);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 15U * 11);
    EXPECT_EQ(bench.stats().drain_slots, 15U * 11); // generation is done, the others wait
}

TEST(TileEngine, AnUprightNeedleIsDoneInTwoSlotsOfEveryPe) {
    // One column wide, far taller than the tile.
    const ProjectedSplat one = one_pixel(5, 8);
    TileEngineBench bench(
        small_engine(),
        make_frame({test::make_splat(5, 8, std::sqrt(one.cov_a), 1000, 0, 0.5)}, 16, 16, 16));
    bench.run(bench.lists({0}));
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 16U);
    EXPECT_EQ(bench.stats().slots[Slot::Boundary], 16U);
    EXPECT_EQ(bench.stats().window.cycles(), 2U);
}

TEST(TileEngine, SplatsOfOnePixelAreTakenOnePerCycle) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 100; ++i) {
        splats.push_back(one_pixel(i % 13, i % 16, 0.1));
    }
    TileEngineBench bench(small_engine(), make_frame(splats, 16, 16, 16));
    bench.run(bench.lists({0}));
    EXPECT_EQ(bench.stats().window.first, bench.first_push() + 1);
    EXPECT_EQ(bench.stats().window.cycles(), 101U); // the last one takes two slots
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 100U);
    EXPECT_EQ(bench.stats().queue_wait, 0U);
}

TEST(TileEngine, AFullQueueHoldsGenerationUntilAnEntryIsLoaded) {
    gbu::TileEngine::Config config = small_engine();
    config.queue_depth = 2;
    // Two splats on row 4 fill its queue while the first is worked on; the one after them, on
    // another row, waits behind the fourth.
    std::vector<ProjectedSplat> splats = many(4, one_row(0, 9, 4, 0.1));
    splats.push_back(one_pixel(3, 12));
    TileEngineBench bench(config, make_frame(splats, 16, 16, 16));
    bench.run(bench.lists({0}));
    const Cycle load = bench.first_push() + 1; // entry i is loaded at load + 11 i
    // Entry 2 takes the cell that entry 0 left at `load`; entry 3 that of entry 1.
    EXPECT_EQ(bench.stats().queue_wait, load + 11 - (bench.first_push() + 3));
    EXPECT_EQ(bench.stats().window.last, load + 43);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 41U);
}

TEST(TileEngine, RowsWithRoomArePushedWhileAnotherWaits) {
    gbu::TileEngine::Config config = small_engine();
    config.queue_depth = 1;
    std::vector<ProjectedSplat> splats = many(3, one_row(0, 9, 4, 0.1));
    splats.push_back(blanket(8, 8, 20, 0.1)); // waits for row 4 alone
    TileEngineBench bench(config, make_frame(splats, 16, 16, 16));
    bench.run(bench.lists({0}));
    const Cycle load = bench.first_push() + 1; // entry i of row 4 is loaded at load + 11 i
    // Entry 1 has the cell at `load`, entry 2 at load + 11, the blanket's row 4 at load + 22.
    EXPECT_EQ(bench.stats().queue_wait, 10U + 10U);
    EXPECT_EQ(bench.stats().window.last, load + 33 + 16);
    // The other rows got theirs in the cycle after entry 2, and were done long before.
    EXPECT_EQ(bench.stats().drain_slots, 15 * (load + 33 + 17 - (load + 12 + 1 + 17)));
}

TEST(TileEngine, ATileThatEndsIsAbandoned) {
    // 0.99 clamps alpha: the third splat finds T = 1e-4 and ends the pixel.
    TileEngineBench bench(small_engine(), make_frame(many(60, blanket(8, 8, 2000, 1)), 16, 16, 16));
    bench.run(bench.lists({0}));
    const Cycle push = bench.first_push();
    const Cycle end = push + 1 + 2 * 17 + 15;      // slot of the last pixel of the third entry
    EXPECT_EQ(bench.stats().window.last, end + 1); // the pixel's probe
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 512U);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], 256U);
    EXPECT_EQ(bench.stats().slots[Slot::Boundary], 48U);
    EXPECT_EQ(bench.stats().pixels_ended, 256U);
    // Entries 0 to 15 fill the queues, 16, 17 and 18 follow the first three loads; 19 waits until
    // the rows have ended.
    EXPECT_EQ(bench.stats().splats, 20U);
    EXPECT_EQ(bench.stats().splats_abandoned, 40U);
    EXPECT_EQ(bench.stats().entries_dropped, 17U * 16);
    EXPECT_EQ(bench.done(), end + 5);
    EXPECT_EQ(bench.units[0]->tile_state.at(0).first, end + 5);
    EXPECT_TRUE(bench.units[0]->tile_state.at(0).second.all_ended);
}

TEST(TileEngine, RowsThatHaveEndedTakeNoEntriesButTheirSplatsTakeACycleEach) {
    // Row 6 ends; 200 splats on it follow, then one elsewhere.
    std::vector<ProjectedSplat> splats = many(3, test::make_splat(8, 6, 4000, 0.05, 0, 1));
    for (int i = 0; i < 200; ++i) {
        splats.push_back(one_pixel(3, 6));
    }
    splats.push_back(one_pixel(9, 13));
    TileEngineBench bench(small_engine(), make_frame(splats, 16, 16, 16));
    bench.run(bench.lists({0}));
    const Cycle push = bench.first_push();
    const Cycle end = push + 1 + 2 * 17 + 15; // of row 6
    // Splats 3 to 16 wait in the queue, 17 and 18 follow the loads of splats 1 and 2, at push + 18
    // and push + 35; 19 waits until the row is known to have ended, at end + 1.
    const Cycle last_push = end + 1 + 184; // splats 20 to 202, then the last one
    EXPECT_EQ(bench.stats().window.last, last_push + 2);
    EXPECT_EQ(bench.stats().rows_skipped, 183U);
    EXPECT_EQ(bench.stats().entries_dropped, 17U);
    EXPECT_EQ(bench.stats().entries, 4U);
    EXPECT_EQ(bench.stats().splats, 204U);
}

TEST(TileEngine, EndedPixelsInsideAnIntervalTakeTheirSlots) {
    std::vector<ProjectedSplat> splats = many(3, one_pixel(7, 2, 1));
    splats.push_back(one_row(4, 10, 2, 0.5));
    TileEngineBench bench(small_engine(), make_frame(splats, 16, 16, 16));
    bench.run(bench.lists({0}));
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 2U + 6);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], 1U + 1);
    EXPECT_EQ(bench.stats().slots[Slot::Boundary], 4U);
}

TEST(TileEngine, FewerPesThanRowsTakeTheirRowsInTurn) {
    TileEngineBench bench(small_engine(8), make_frame({blanket(8, 8, 20)}, 16, 16, 16));
    bench.run(bench.lists({0}));
    EXPECT_EQ(bench.stats().window.cycles(), 34U);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 256U);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 0U);
}

TEST(TileEngine, LatenciesShiftDatesAndNothingElse) {
    gbu::TileEngine::Config config = small_engine();
    config.generation_latency = 8;
    config.row_pe_latency = 10;
    // A list in three chunks that are all there: the pipeline is filled once.
    TileEngineBench bench(config, make_frame(many(6, blanket(8, 8, 20, 0.1)), 16, 16, 16));
    bench.run({{1, 0, 0, 2, false}, {2, 0, 2, 2, false}, {3, 0, 4, 2, true}});
    EXPECT_EQ(bench.stats().window.first, 10U);
    EXPECT_EQ(bench.stats().window.cycles(), 6U * 17);
    EXPECT_EQ(bench.done(), 10 + 6 * 17 - 1 + 10);
}

TEST(TileEngine, WaitsForChunks) {
    TileEngineBench bench(small_engine(), make_frame(many(2, one_pixel(3, 3)), 16, 16, 16));
    bench.run({{1, 0, 0, 1, false}, {101, 0, 1, 1, true}});
    EXPECT_EQ(bench.stats().window.first, 5U);
    EXPECT_EQ(bench.stats().window.last, 106U);
    EXPECT_EQ(bench.stats().input_wait, 99U); // from the cycle after its push
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 16U * 102 - 4);
}

TEST(TileEngine, AnEmptyChunkEndsATile) {
    TileEngineBench bench(small_engine(), make_frame(many(2, one_pixel(3, 3)), 16, 16, 16));
    bench.run({{1, 0, 0, 1, false}, {50, 0, 1, 0, true}});
    EXPECT_EQ(bench.stats().splats, 1U);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 1U);
    EXPECT_EQ(bench.units[0]->tile_done.size(), 1U);
}

TEST(TileEngine, WaitingForAContextIsBlocked) {
    const std::vector<ProjectedSplat> splats{one_row(0, 9, 4), one_row(16, 25, 4)};
    TileEngineBench bench(small_engine(), make_frame(splats, 32, 16, 16));
    bench.context_dates = {60};
    bench.run(bench.lists({0, 1}));
    const Cycle end = bench.first_push() + 1 + 11; // the barrier of tile 0
    EXPECT_EQ(bench.stats().window.last, 60U + 11);
    EXPECT_EQ(bench.stats().slots[Slot::Blocked], 16 * (60 - end));
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 20U);
}

// The third tile waits for its context, too; what the second has waited is over.
TEST(TileEngine, EveryWaitForAContextIsBlockedOnce) {
    const std::vector<ProjectedSplat> splats{one_row(0, 9, 4), one_row(16, 25, 4),
                                             one_row(32, 41, 4)};
    TileEngineBench bench(small_engine(), make_frame(splats, 48, 16, 16));
    bench.context_dates = {60, 100};
    bench.run(bench.lists({0, 1, 2}));
    const Cycle end = bench.first_push() + 1 + 11;
    EXPECT_EQ(bench.stats().window.last, 100U + 11);
    EXPECT_EQ(bench.stats().slots[Slot::Blocked], 16 * ((60 - end) + (100 - 72)));
}

// Row 0 has five splats of its own before three that end every row, for itself the second of them:
// generation is done with it first, and its pixels end last.
TEST(TileEngine, ATileEndsWithItsLastSlot) {
    std::vector<ProjectedSplat> splats = many(5, one_row(0, 15, 0, 0.1));
    for (const ProjectedSplat& splat : many(3, blanket(8, 8, 2000, 1))) {
        splats.push_back(splat);
    }
    TileEngineBench bench(small_engine(), make_frame(splats, 16, 16, 16));
    bench.run(bench.lists({0}));
    const Cycle end = bench.first_push() + 1 + 6 * 17 + 15;
    EXPECT_TRUE(bench.units[0]->tile_state.at(0).second.all_ended);
    EXPECT_EQ(bench.units[0]->tile_state.at(0).first, end + 5);
    EXPECT_EQ(bench.done(), end + 5);
}

TEST(TileEngine, TheNextTileWaitsForAllPes) {
    std::vector<ProjectedSplat> splats{one_row(0, 9, 4), one_row(16, 25, 8)};
    TileEngineBench bench(small_engine(), make_frame(splats, 32, 16, 16), 1, 2);
    bench.run(bench.lists({0, 1}));
    // The records of the next tile are there, but the first tile keeps PE 4 busy.
    EXPECT_EQ(bench.stats().window.cycles(), 11U + 1 + 11);
    EXPECT_EQ(bench.stats().slots[Slot::Blocked], 0U);
}

TEST(TileEngine, EnginesWorkOnTilesOfTheirOwn) {
    TileEngineBench bench(small_engine(), test::random_frame(5, 61, 45, 16, 150), 2, 1);
    std::vector<TileNumber> even, odd;
    for (TileNumber t = 0; t < bench.job.tiles.size(); ++t) {
        (t % 2 == 0 ? even : odd).push_back(t);
    }
    bench.run({bench.lists(even), bench.lists(odd)});
    EXPECT_EQ(bench.stats(0).window.first, bench.stats(1).window.first);
    bench.expect_reference();
}

class SmallRunTileEngine : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunTileEngine, RendersTheReference) {
    const unsigned seed = GetParam();
    gbu::TileEngine::Config config = small_engine(seed % 3 == 0 ? 8 : 16);
    config.queue_depth = 1 + static_cast<int>(seed % 5);
    TileEngineBench bench(config, test::random_frame(seed, 40, 37, 16, 400));
    std::vector<TileNumber> all(bench.job.tiles.size());
    for (TileNumber t = 0; t < all.size(); ++t) {
        all[t] = t;
    }
    bench.run(bench.lists(all));
    bench.expect_reference();
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunTileEngine, ::testing::Range(0U, 6U));

} // namespace
} // namespace degs
