// SPDX-License-Identifier: Apache-2.0
// Cycle counts of the lockstep array against what the rule says, one small case each.
#include "tests/baselines/gscore/lockstep_bench.hpp"

#include <cmath>

namespace degs {
namespace {

using test::blanket;
using test::LockstepBench;
using test::make_frame;
using test::make_splat;
using test::one_pixel;
using test::one_row;
using Config = gscore::LockstepArray::Config;

Config lanes(int n) {
    Config config;
    config.lanes = n;
    return config;
}
Config skip(SubtileTest test) {
    Config config;
    config.subtile_skip = test;
    return config;
}

struct Expected {
    std::uint64_t passes, useful;
};
/// One tile, its list in one chunk: the window is `passes` cycles long from the chunk's date on.
void expect_one_tile(const Config& config, const std::vector<ProjectedSplat>& splats,
                     const Expected& expected) {
    LockstepBench bench("bench", config, make_frame(splats, 16, 16, 16), {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    const gscore::LockstepArray::Stats& stats = bench.stats();
    EXPECT_EQ(stats.passes, expected.passes);
    EXPECT_EQ(stats.window.first, LockstepBench::kStart);
    EXPECT_EQ(stats.window.cycles(), expected.passes);
    EXPECT_EQ(stats.slots[Slot::Useful], expected.useful);
    EXPECT_EQ(stats.slots[Slot::Boundary],
              expected.passes * static_cast<std::uint64_t>(config.lanes) - expected.useful);
    const Cycle end = stats.window.last + 1;
    EXPECT_EQ(bench.tile_done[0], end + static_cast<Cycle>(config.pipeline_cycles));
    EXPECT_EQ(bench.tile_state[0], end + 1);
    EXPECT_FALSE(bench.all_ended[0]);
    bench.expect_sound();
}

struct Scaling {
    int lanes, tile;
};
std::ostream& operator<<(std::ostream& out, const Scaling& s) {
    return out << s.lanes << "_lanes";
}
class FullTile : public ::testing::TestWithParam<Scaling> {};

// Every sub-tile once, every lane useful.
TEST_P(FullTile, TakesASlotPerSubtile) {
    const Scaling s = GetParam();
    const Config config = lanes(s.lanes);
    ASSERT_EQ(config.tile_size(), s.tile);
    LockstepBench bench(
        "bench", config,
        make_frame({blanket(s.tile / 2.0, s.tile / 2.0, s.tile)}, s.tile, s.tile, s.tile), {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    const auto pixels = static_cast<std::uint64_t>(s.tile * s.tile);
    EXPECT_EQ(bench.stats().passes, pixels / static_cast<std::uint64_t>(s.lanes));
    EXPECT_EQ(bench.stats().window.cycles(), bench.stats().passes);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], pixels);
    EXPECT_EQ(bench.stats().slots.total(), pixels);
    bench.expect_sound();
}
INSTANTIATE_TEST_SUITE_P(Lanes, FullTile,
                         ::testing::Values(Scaling{16, 16}, Scaling{64, 16}, Scaling{256, 32},
                                           Scaling{1024, 64}),
                         ::testing::PrintToStringParamName());

// The pixel's own sub-tile, 63 lanes in vain.
TEST(LockstepArray, OnePixelTakesOneSlot) {
    expect_one_tile(lanes(64), {one_pixel(3, 3)}, {1, 1});
}

// Without a bitmap all four sub-tiles are evaluated.
TEST(LockstepArray, WithoutBitmapOnePixelTakesFour) {
    expect_one_tile(skip(SubtileTest::None), {one_pixel(3, 3)}, {4, 1});
}

// Two sub-tiles of 8 x 8, or four of 4 x 4: 16 useful lanes in all.
TEST(LockstepArray, OneRow) {
    expect_one_tile(lanes(64), {one_row(0, 15, 3)}, {2, 16});
}
TEST(LockstepArray, OneRowIn16Lanes) {
    expect_one_tile(lanes(16), {one_row(0, 15, 2)}, {4, 16});
}

/// Through the crossing of the four sub-tiles at (7.5, 7.5) along the diagonal. Q_th = 2 ln 2, so
/// it is 0.5477 * 1.177 = 0.645 px to a side and 11.8 px long: the pixels (i, i) for i in
/// 0 .. 15 are on its axis, their neighbours (i + 1, i) are 0.707 px off.
ProjectedSplat diagonal_needle() {
    return make_splat(7.5, 7.5, 10, std::sqrt(0.3), std::acos(-1.0) / 4, 2.0 / 255);
}

// The needle's box touches the corner of the two sub-tiles that hold none of its pixels.
TEST(LockstepArray, DiagonalNeedleByItsBox) {
    expect_one_tile(skip(SubtileTest::Obb), {diagonal_needle()}, {4, 16});
}
TEST(LockstepArray, DiagonalNeedleExactly) {
    expect_one_tile(skip(SubtileTest::Exact), {diagonal_needle()}, {2, 16});
}

// Splats in depth order, each as many slots as it has sub-tiles, back to back.
TEST(LockstepArray, SlotsAddUp) {
    expect_one_tile(lanes(64),
                    {one_row(0, 15, 3, 0.1), one_pixel(3, 3, 0.1), blanket(8, 8, 16, 0.1),
                     one_pixel(3, 3, 0.1)},
                    {2 + 1 + 4 + 1, 16 + 1 + 256 + 1});
}

class LockstepTermination : public ::testing::TestWithParam<int> {};

// alpha = 0.98: the third of the splats ends all pixels (T = 8e-6 is refused), sub-tile s in cycle
// 8 + s. The slots that see it start D cycles later; until then the fourth splat finds its
// sub-tiles not done. With D = 4 they are: cycle 12 skips sub-tile 0 and goes to 1, then 2, 3.
TEST_P(LockstepTermination, TileStopsWhenItsLastSubtileIsSeenDone) {
    Config config;
    config.termination_cycles = GetParam();
    LockstepBench bench(
        "bench", config,
        make_frame(std::vector<ProjectedSplat>(20, blanket(8, 8, 1e4, 0.98)), 16, 16, 16), {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    const std::uint64_t late = GetParam() == 1 ? 0 : 3;
    EXPECT_EQ(bench.stats().passes, 12 + late);
    EXPECT_EQ(bench.stats().window.cycles(), 12 + late);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 2U * 256);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], 256 + late * 64);
    EXPECT_EQ(bench.stats().slots[Slot::Boundary], 0U);
    EXPECT_EQ(bench.stats().pixels_ended, 256U);
    EXPECT_EQ(bench.stats().splats, late == 0 ? 3U : 4U);
    EXPECT_EQ(bench.stats().tiles_stopped, 0U); // the list was there to its end
    const Cycle stop = LockstepBench::kStart + 12 + late;
    EXPECT_EQ(bench.tile_state[0], stop + 1);
    EXPECT_EQ(bench.tile_done[0], stop + static_cast<Cycle>(config.pipeline_cycles));
    EXPECT_TRUE(bench.all_ended[0]);
    bench.expect_sound();
}
INSTANTIATE_TEST_SUITE_P(Delays, LockstepTermination, ::testing::Values(1, 4));

// With D = 8 the last end, in cycle 11, is seen in cycle 19. A second chunk that comes before is
// worked on, one that comes then is not wanted any more.
class ChunkAfterTheEnd : public ::testing::TestWithParam<Cycle> {};
TEST_P(ChunkAfterTheEnd, IsWorkedOnWhileTheEndIsNotSeen) {
    Config config;
    config.termination_cycles = 8;
    LockstepBench bench(
        "bench", config,
        make_frame(std::vector<ProjectedSplat>(20, blanket(8, 8, 1e4, 0.98)), 16, 16, 16), {});
    bench.chunk(0, 3, LockstepBench::kStart);
    bench.chunk(0, 17, LockstepBench::kStart + GetParam());
    LockstepBench::start();
    // Cycles 14, 15 (sub-tiles 2, 3 are seen done from 18, 19 on; 0 and 1 from 16, 17 on): the
    // splats of the chunk go round the sub-tiles that are not seen done yet, a slot per cycle.
    const Cycle used = GetParam() < 19 ? 19 - GetParam() : 0;
    EXPECT_EQ(bench.stats().passes, 12 + used);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], 256 + used * 64);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], used == 0 ? 0 : (GetParam() - 12) * 64);
    EXPECT_EQ(bench.stats().tiles_stopped, used == 0 ? 1U : 0U);
    EXPECT_EQ(bench.tile_state[0], LockstepBench::kStart + 19 + 1);
    EXPECT_TRUE(bench.all_ended[0]);
    bench.expect_sound();
}
INSTANTIATE_TEST_SUITE_P(Dates, ChunkAfterTheEnd, ::testing::Values(14, 18, 19, 20, 100));

// Three splats of alpha 0.98 on each pixel of sub-tile 0, then one over everything.
TEST(LockstepArray, DoneSubtilesAreSkipped) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 3 * 64; ++i) {
        splats.push_back(one_pixel(i % 8, i / 8 % 8, 0.98));
    }
    splats.push_back(blanket(8, 8, 16, 0.1));
    LockstepBench bench("bench", skip(SubtileTest::Exact), make_frame(splats, 16, 16, 16), {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    EXPECT_EQ(bench.stats().passes, 3U * 64 + 3);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 2U * 64 + 3 * 64);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], 64U); // the refused ones
    EXPECT_EQ(bench.stats().pixels_ended, 64U);
    EXPECT_FALSE(bench.all_ended[0]);
    bench.expect_sound();
}

// The second tile has 4 of 16 columns in the image: its two left sub-tiles, half of whose lanes are
// outside.
TEST(LockstepArray, LanesOutsideTheImageAreBoundary) {
    LockstepBench bench("bench", {}, make_frame({blanket(10, 8, 16)}, 20, 16, 16), {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    EXPECT_EQ(bench.stats().passes, 4U + 2);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 256U + 4 * 16);
    EXPECT_EQ(bench.stats().slots[Slot::Boundary], 2U * 64 - 4 * 16);
    bench.expect_sound();
}

// Two clusters of 32 lanes take two cycles per sub-tile. Cluster 0 owns sub-tiles 0 and 2, cluster
// 1 owns 1 and 3: a full tile keeps both busy for four cycles. Then two splats in sub-tile 0 and
// one in 1: cluster 1 waits two cycles for the tile's end, 32 lanes each.
TEST(LockstepClusters, WorkOnTheirOwnAndMeetAtTheTileEnd) {
    Config config;
    config.clusters = 2;
    LockstepBench bench("bench", config,
                        make_frame({blanket(8, 8, 8, 0.1), one_pixel(3, 3), one_pixel(3, 4),
                                    one_pixel(11, 3), blanket(24, 8, 8, 0.1)},
                                   32, 16, 16),
                        {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    const std::uint64_t both = 2; // the blankets reach into the neighbouring tile as well
    EXPECT_EQ(bench.stats().passes, 2 * both * 4 + 3);
    EXPECT_EQ(bench.stats().window.cycles(), both * 4 + 4 + both * 4);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 2U * 32);
    EXPECT_EQ(bench.stats().slots[Slot::Drain], 0U);
    bench.expect_sound();
}

// Four clusters of 16 lanes, one sub-tile each: the whole tile in four cycles, and one sub-tile in
// four as well, with three clusters idle.
TEST(LockstepClusters, OneSubtileEach) {
    Config config;
    config.clusters = 4;
    LockstepBench bench(
        "bench", config,
        make_frame({blanket(8, 8, 16, 0.1), one_pixel(3, 3), one_pixel(3, 3)}, 16, 16, 16), {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    EXPECT_EQ(bench.stats().window.cycles(), 4U + 2 * 4);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 256U + 2);
    EXPECT_EQ(bench.stats().slots[Slot::Drain], 3U * 16 * 8);
    bench.expect_sound();
}

// A cluster that is done takes the next chunk while the other still works on the one before.
TEST(LockstepClusters, DoNotWaitForEachOtherWithinATile) {
    Config config;
    config.clusters = 2;
    std::vector<ProjectedSplat> splats(8, one_pixel(3, 3, 0.1)); // sub-tile 0: 16 cycles
    splats.insert(splats.end(), 8, one_pixel(11, 3, 0.1));       // sub-tile 1
    LockstepBench bench("bench", config, make_frame(splats, 16, 16, 16), {});
    bench.chunk(0, 8, LockstepBench::kStart);
    bench.chunk(0, 8, LockstepBench::kStart + 5);
    LockstepBench::start();
    EXPECT_EQ(bench.stats().window.cycles(), 5U + 16);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 5U * 32); // cluster 1 until its first splat
    EXPECT_EQ(bench.stats().slots[Slot::Drain], 5U * 32);   // cluster 0 at the end
    bench.expect_sound();
}

// Sub-tile 0 has ended, and ten splats of it follow before one over everything: as many per cycle
// are passed over as the key says, and the lanes wait for it.
class PassedOver : public ::testing::TestWithParam<std::pair<int, Cycle>> {};
TEST_P(PassedOver, TakesACyclePerSkips) {
    const auto [skips, cycles] = GetParam();
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 3 * 64 + 10; ++i) {
        splats.push_back(one_pixel(i % 8, i / 8 % 8, 0.98));
    }
    splats.push_back(blanket(8, 8, 16, 0.1));
    Config config = skip(SubtileTest::Exact);
    config.skips_per_cycle = skips;
    LockstepBench bench("bench", config, make_frame(splats, 16, 16, 16), {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    EXPECT_EQ(bench.stats().splats_skipped, 10U);
    EXPECT_EQ(bench.stats().passes, 3U * 64 + 3);
    EXPECT_EQ(bench.stats().window.cycles(), 3U * 64 + cycles + 3);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 64 * cycles);
    bench.expect_sound();
}
INSTANTIATE_TEST_SUITE_P(Skips, PassedOver,
                         ::testing::Values(std::pair<int, Cycle>(0, 0),
                                           std::pair<int, Cycle>(1, 10),
                                           std::pair<int, Cycle>(2, 5), std::pair<int, Cycle>(3, 3),
                                           std::pair<int, Cycle>(4, 2)));

// The second tile waits for the only context and later, when it has it, for its second chunk, which
// is no fault of the Pixel Buffer.
TEST(LockstepArray, AContextIsWaitedForOnce) {
    LockstepBench::Sizes sizes;
    sizes.contexts = 1;
    sizes.readout = 30;
    const Config config;
    LockstepBench bench(
        "bench", config,
        make_frame({one_pixel(3, 3), one_pixel(19, 3), one_pixel(19, 4)}, 32, 16, 16), sizes);
    bench.chunk(0, 1, LockstepBench::kStart);
    bench.chunk(1, 1, LockstepBench::kStart);
    const Cycle begun = // a slot, written back, read out, and a cycle on the wire
        LockstepBench::kStart + 1 + static_cast<Cycle>(config.pipeline_cycles) + 30 + 1;
    bench.chunk(1, 1, begun + 500);
    LockstepBench::start();
    EXPECT_EQ(bench.stats().window.last, begun + 500);
    EXPECT_EQ(bench.stats().slots[Slot::Blocked], (begun - LockstepBench::kStart - 1) * 64);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 499U * 64);
    bench.expect_sound();
}

} // namespace
} // namespace degs
