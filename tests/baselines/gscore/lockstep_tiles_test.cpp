// SPDX-License-Identifier: Apache-2.0
// Tiles after each other: contexts, waits, the rest of stopped tiles; and whole random frames.
#include <cstring>

#include "splat/reference/reference_renderer.hpp"
#include "tests/baselines/gscore/lockstep_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::LockstepBench;
using test::make_frame;
using test::one_pixel;
using Config = gscore::LockstepArray::Config;

/// `tiles` tiles in a row, all covered by each of `count` splats.
FrameWorkload blankets(int tiles, int count, double opacity) {
    return make_frame(std::vector<ProjectedSplat>(static_cast<std::size_t>(count),
                                                  blanket(8.0 * tiles, 8, 1e4, opacity)),
                      16 * tiles, 16, 16);
}

// Two contexts hide pipeline and readout behind the other tile: no bubble.
TEST(LockstepTiles, TwoContextsLeaveNoBubble) {
    Config config;
    LockstepBench::Sizes sizes;
    sizes.contexts = 2;
    sizes.readout = 20;
    LockstepBench bench("bench", config, blankets(6, 10, 0.1), sizes);
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    EXPECT_EQ(bench.stats().window.cycles(), 6U * 40);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 6U * 40 * 64);
    bench.expect_sound();
}

// One context: between two tiles the pipeline, the readout and the hand-over.
TEST(LockstepTiles, OneContextBlocksBetweenTiles) {
    Config config;
    config.pipeline_cycles = 6;
    LockstepBench::Sizes sizes;
    sizes.contexts = 1;
    sizes.readout = 20;
    LockstepBench bench("bench", config, blankets(3, 10, 0.1), sizes);
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    const Cycle gap = 6 + 20 + 1;
    EXPECT_EQ(bench.stats().window.cycles(), 3 * 40 + 2 * gap);
    EXPECT_EQ(bench.stats().slots[Slot::Blocked], 2 * gap * 64);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 0U);
    bench.expect_sound();
}

// The context is free after 27 cycles, the second tile's chunk comes 5 cycles earlier or later.
class StarvedAndBlocked : public ::testing::TestWithParam<int> {};
TEST_P(StarvedAndBlocked, AreToldApart) {
    Config config;
    config.pipeline_cycles = 6;
    LockstepBench::Sizes sizes;
    sizes.contexts = 1;
    sizes.readout = 20;
    LockstepBench bench("bench", config, blankets(2, 10, 0.1), sizes);
    const Cycle free = LockstepBench::kStart + 40 + 27;
    const Cycle there = free + static_cast<Cycle>(5 + GetParam()) - 5;
    bench.chunk(0, 10, LockstepBench::kStart);
    bench.chunk(1, 10, there);
    LockstepBench::start();
    const Cycle blocked = there < free ? free - there : 0;
    EXPECT_EQ(bench.stats().slots[Slot::Blocked], blocked * 64);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], (there - (LockstepBench::kStart + 40)) * 64);
    EXPECT_EQ(bench.stats().window.last, std::max(free, there) + 39);
    bench.expect_sound();
}
INSTANTIATE_TEST_SUITE_P(Dates, StarvedAndBlocked, ::testing::Values(-5, 0, 5), [](const auto& p) {
    return p.param < 0 ? "before" : p.param == 0 ? "together" : "after";
});

// A splat without a bit set costs nothing, and neither does a tile of such splats.
TEST(LockstepTiles, SplatsWithoutBitsCostNothing) {
    FrameWorkload frame =
        make_frame({one_pixel(3, 3), one_pixel(19, 3), one_pixel(35, 3)}, 48, 16, 16);
    frame.tile_splats[1] = 0; // the second tile lists a splat of the first
    LockstepBench bench("bench", {}, frame, {});
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    EXPECT_EQ(bench.stats().passes, 2U);
    EXPECT_EQ(bench.stats().splats_skipped, 1U);
    EXPECT_EQ(bench.tile_done[1], bench.tile_done[0]); // the chunk of tile 1 comes a cycle later
    bench.expect_sound();
}

// Input 0 still brings chunks of the stopped tile 0 while tile 1 comes on input 1: nobody waits.
TEST(LockstepTiles, RestOfAStoppedTileIsDroppedOnTheSide) {
    LockstepBench::Sizes sizes;
    sizes.inputs = 2;
    LockstepBench bench("bench", {}, blankets(4, 20, 0.98), sizes);
    bench.chunk(0, 5, LockstepBench::kStart);
    bench.chunk(0, 5, LockstepBench::kStart + 2);   // there when the tile stops
    bench.chunk(0, 10, LockstepBench::kStart + 20); // comes in the middle of tile 1
    bench.chunk(1, 20, LockstepBench::kStart);
    bench.chunk(2, 20, LockstepBench::kStart + 21);
    bench.chunk(3, 20, LockstepBench::kStart);
    LockstepBench::start();
    // 12 slots a tile; tile 1 follows at once, tile 2 when it is there.
    EXPECT_EQ(bench.stats().window.cycles(), 4U * 12);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], 0U);
    EXPECT_EQ(bench.stats().tiles_stopped, 1U);
    EXPECT_EQ(bench.stats().splats, 4U * 3);
    EXPECT_EQ(bench.tile_state,
              (std::vector<Cycle>{LockstepBench::kStart + 13, LockstepBench::kStart + 25,
                                  LockstepBench::kStart + 37, LockstepBench::kStart + 49}));
    bench.expect_sound();
}

// With one input the next tile's list is behind the rest of the stopped one.
TEST(LockstepTiles, WithOneInputTheRestIsInTheWay) {
    LockstepBench bench("bench", {}, blankets(2, 20, 0.98), {});
    bench.chunk(0, 5, LockstepBench::kStart);
    bench.chunk(0, 15, LockstepBench::kStart + 50);
    bench.chunk(1, 20, LockstepBench::kStart + 60);
    LockstepBench::start();
    EXPECT_EQ(bench.stats().window.cycles(), 60U + 12);
    EXPECT_EQ(bench.stats().slots[Slot::Starved], (60U - 12) * 64);
    bench.expect_sound();
}

struct Random {
    int lanes, clusters, termination;
    SubtileTest skip;
    int contexts;
    unsigned seed;
};
std::ostream& operator<<(std::ostream& out, const Random& r) {
    return out << r.lanes << "_c" << r.clusters << "_d" << r.termination << "_s"
               << static_cast<int>(r.skip) << "_x" << r.contexts << "_" << r.seed;
}
class SmallRunLockstep : public ::testing::TestWithParam<Random> {
protected:
    static Config config() {
        Config config;
        config.lanes = GetParam().lanes;
        config.clusters = GetParam().clusters;
        config.termination_cycles = GetParam().termination;
        config.subtile_skip = GetParam().skip;
        return config;
    }
    static LockstepBench::Sizes sizes() {
        LockstepBench::Sizes sizes;
        sizes.inputs = 1 + GetParam().seed % 3;
        sizes.contexts = GetParam().contexts;
        sizes.ring = 2;
        sizes.readout = 9;
        sizes.chunk = 7;
        sizes.chunk_gap = 11;
        return sizes;
    }
    static FrameWorkload frame() {
        const int tile = config().tile_size();
        return test::random_frame(GetParam().seed, 3 * tile - 5, 2 * tile + 3, tile, 400);
    }
};

// Every pixel and every update as the reference renderer has them.
TEST_P(SmallRunLockstep, RendersTheReferenceImage) {
    const FrameWorkload work = frame();
    LockstepBench bench("bench", config(), work, sizes());
    bench.chunks_of_all_tiles();
    LockstepBench::start();
    bench.expect_sound();
    ReferenceCounts counts;
    const Image reference = render_reference(work, counts);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], counts.fragments);
    for (int y = 0; y < work.camera.height; ++y) {
        for (int x = 0; x < work.camera.width; ++x) {
            const std::size_t i = reference.at(x, y);
            const PixelValue& pixel = bench.pixel(x, y);
            ASSERT_EQ(pixel.updates, reference.fragments[i]) << x << ", " << y;
            for (std::size_t c = 0; c < 3; ++c) { // the reference image is rounded to float
                const double value = reference.rgb[3 * i + c];
                ASSERT_NEAR(pixel.rgb[c], value, 1e-12 + 0x1p-24 * std::abs(value));
            }
            ASSERT_NEAR(pixel.transmittance, reference.transmittance[i],
                        1e-12 + 0x1p-24 * reference.transmittance[i]);
        }
    }
}

// Processes that run ahead of each other decide as those that sleep to each of their dates.
TEST_P(SmallRunLockstep, ExactEqualsStrict) {
    const FrameWorkload work = frame();
    LockstepBench exact("exact", config(), work, sizes());
    LockstepBench strict("strict", config(), work, sizes(), Fidelity::Strict);
    exact.chunks_of_all_tiles();
    strict.chunks_of_all_tiles();
    LockstepBench::start();
    exact.expect_sound();
    static_assert(std::is_trivially_copyable_v<gscore::LockstepArray::Stats>);
    EXPECT_EQ(std::memcmp(&exact.stats(), &strict.stats(), sizeof(gscore::LockstepArray::Stats)),
              0);
    EXPECT_EQ(exact.tile_done, strict.tile_done);
    EXPECT_EQ(exact.tile_state, strict.tile_state);
    for (std::size_t i = 0; i < sizes().inputs; ++i) {
        EXPECT_EQ(exact.ring(i).stats().full_cycles, strict.ring(i).stats().full_cycles);
        EXPECT_EQ(exact.ring(i).stats().occupied_cycles, strict.ring(i).stats().occupied_cycles);
    }
}

INSTANTIATE_TEST_SUITE_P(Configs, SmallRunLockstep,
                         ::testing::Values(Random{64, 1, 1, SubtileTest::Obb, 2, 1},
                                           Random{64, 1, 4, SubtileTest::Exact, 1, 2},
                                           Random{64, 1, 30, SubtileTest::None, 2, 3},
                                           Random{64, 4, 1, SubtileTest::Obb, 2, 4},
                                           Random{64, 2, 9, SubtileTest::Obb, 1, 5},
                                           Random{16, 1, 1, SubtileTest::Obb, 2, 6},
                                           Random{256, 1, 2, SubtileTest::Exact, 2, 7},
                                           Random{256, 4, 1, SubtileTest::Obb, 1, 8},
                                           Random{1024, 1, 1, SubtileTest::Obb, 2, 9}),
                         ::testing::PrintToStringParamName());

} // namespace
} // namespace degs
