// SPDX-License-Identifier: Apache-2.0
// Whole accelerators on frames made by hand: the image is the reference's to the byte, nothing is
// lost, and the corners of the configuration space work.
#include <limits>

#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::blanket;
using test::DegsRun;
using test::exact_arithmetic;
using test::make_frame;
using test::one_pixel;
using test::one_row;
using test::random_frame;
using test::Shape;

/// Runs one frame and checks what holds of every run in double precision.
std::unique_ptr<DegsRun> run(const DegsConfig& config, const FrameWorkload& frame) {
    auto result =
        std::make_unique<DegsRun>("degs", config, std::vector<const FrameWorkload*>{&frame});
    sc_core::sc_start();
    test::expect_sound(*result);
    test::expect_reference(*result);
    return result;
}

DegsConfig tiles_of(int size) {
    return test::shaped(exact_arithmetic(), {size, 2, 8, 8, 8});
}

TEST(SmallRun, NoSplatsAtAll) {
    const FrameWorkload frame = make_frame({}, 40, 30, 16);
    const auto result = run(tiles_of(16), frame);
    EXPECT_EQ(result->job().tiles.size(), 0U);
    EXPECT_GT(result->degs().finished(), 0U); // the background is written
    EXPECT_EQ(result->degs().streams().total().bytes_written, (40U * 30 * 4 + 63) / 64 * 64);
    for (const float t : result->image().transmittance) {
        EXPECT_EQ(t, 1.0F);
    }
}

// The host holds what is used; these buffers as a whole would take it 30 GB.
TEST(SmallRun, HugeBuffersChangeNothing) {
    const FrameWorkload frame = test::random_frame(4, 90, 70, 16, 200);
    DegsConfig config = tiles_of(16);
    config.packing.bytes = 64 * 1024 * 1024;
    config.gaussian_buffer.bytes = 64 * 1024 * 1024;
    config.span_buffer.bytes = 64 * 1024 * 1024;
    config.pixel_buffer.bytes = 64 * config.pixel_buffer.state_bytes * 16 * 16; // more than tiles
    DegsConfig huge = config;
    huge.packing.bytes = huge.gaussian_buffer.bytes = huge.span_buffer.bytes = 1 << 30;
    huge.pixel_buffer.bytes = kMostContexts * config.pixel_buffer.state_bytes * 16 * 16;
    const DegsRun large("large", config, {&frame});
    const DegsRun most("most", huge, {&frame});
    sc_core::sc_start();
    test::expect_sound(most);
    test::expect_reference(most);
    EXPECT_EQ(most.degs().finished(), large.degs().finished());
    EXPECT_EQ(most.slots()[Slot::Starved], large.slots()[Slot::Starved]);
}

TEST(SmallRun, MoreContextsThanAreNumberedAreRefused) {
    DegsConfig config;
    config.tile_size = 4;
    config.pixel_buffer.state_bytes = 1;
    config.pixel_buffer.bytes = 16 * (kMostContexts + 1) - 1;
    EXPECT_EQ(config.problem(), "");
    config.pixel_buffer.bytes = 16 * (kMostContexts + 1);
    EXPECT_EQ(config.problem(), "default: key 'pixel_buffer.bytes' is 524288, but must not hold "
                                "more than 32767 tiles of 4 x 4 px; 524272 would do.");
    config.pixel_buffer.bytes = 15;
    EXPECT_EQ(config.problem(), "default: key 'pixel_buffer.bytes' is 15, but must be at least 16 "
                                "to hold 1 tile of 4 x 4 px.");
}

TEST(SmallRun, GaussiansThatNobodySees) {
    FrameWorkload frame = make_frame({}, 40, 30, 16);
    frame.gaussians = 1000;
    const auto result = run(tiles_of(16), frame);
    EXPECT_GE(result->degs().streams().total().bytes_read, 1000U * 22);
}

TEST(SmallRun, OnePixelOneSplat) {
    const FrameWorkload frame = make_frame({one_pixel(0, 0)}, 1, 1, 32);
    const auto result = run(tiles_of(32), frame);
    EXPECT_EQ(result->slots()[Slot::Useful], 1U);
    EXPECT_EQ(result->slots().total(), 64U); // one cycle of all PEs
    EXPECT_NEAR(result->image().transmittance[0], 0.5F, 1e-6);
}

TEST(SmallRun, ATileLargerThanTheImage) {
    const FrameWorkload frame = random_frame(1, 19, 7, 128, 60);
    run(tiles_of(128), frame);
}

TEST(SmallRun, OneRowGoesToOneBank) {
    const FrameWorkload frame = make_frame({one_row(0, 31, 5, 0.3)}, 32, 32, 32);
    const auto result = run(tiles_of(32), frame);
    for (std::size_t b = 0; b < 8; ++b) {
        EXPECT_EQ(result->degs().banks()[b]->stats().tasks_in, b == 5 ? 32U : 0U);
    }
    EXPECT_EQ(result->packets(), 4U);
    EXPECT_EQ(result->window().cycles(), 4U);
}

// 32 x 32 pixels for 64 PEs: 16 cycles if nothing comes between.
TEST(SmallRun, AFullTileTakesPixelsOverPes) {
    const FrameWorkload frame = make_frame({blanket(16, 16, 32)}, 32, 32, 32);
    const auto result = run(tiles_of(32), frame);
    EXPECT_EQ(result->slots()[Slot::Useful], 1024U);
    EXPECT_EQ(result->packets(), 128U);
    EXPECT_EQ(result->window().cycles(), 16U);
}

TEST(SmallRun, ADiagonalNeedle) {
    const FrameWorkload frame =
        make_frame({test::make_splat(30, 30, 400, 0.55, 0.7, 0.9)}, 64, 64, 32);
    run(tiles_of(32), frame);
}

// One pixel again and again: executions are exactly the reuse distance apart.
TEST(SmallRun, TheReuseDistanceHoldsAtTheArray) {
    const std::vector<ProjectedSplat> splats(40, one_pixel(3, 3, 0.02));
    const FrameWorkload frame = make_frame(splats, 16, 16, 16);
    const auto result = run(tiles_of(16), frame);
    EXPECT_EQ(result->window().cycles(), 39U * 4 + 1);
    EXPECT_EQ(result->packets(), 40U);
}

// Without a scoreboard the image is wrong.
TEST(SmallRun, WithoutScoreboardPixelsAreUpdatedTooEarly) {
    const FrameWorkload frame = random_frame(2, 64, 64, 32, 150);
    DegsConfig config = tiles_of(32);
    config.scheduler.scoreboard = false;
    config.packing.bytes *= 4;
    config.scheduler.issue_width = 8;
    const DegsRun early("early", config, {&frame});
    sc_core::sc_start();
    test::expect_sound(early);
    EXPECT_GT(early.hazards(), 0U);
    ReferenceCounts counts;
    EXPECT_FALSE(test::same_bytes(early.image(), render_reference(frame, counts)));
}

// With a scoreboard the image is right, even if queues run full and drain back to back.
TEST(SmallRun, WithScoreboardNeverEvenIfDeepQueuesDrain) {
    const FrameWorkload frame = random_frame(2, 64, 64, 32, 150);
    DegsConfig config = tiles_of(32);
    config.packing.bytes *= 4;
    config.scheduler.issue_width = 8;
    config.scheduler.segments_per_cycle = 8;
    run(config, frame);
}

/// Opaque over two tiles, with a long list behind.
FrameWorkload opaque_frame() {
    std::vector<ProjectedSplat> splats(5, blanket(16, 8, 1e3, 0.98));
    for (int i = 0; i < 1000; ++i) {
        splats.push_back(blanket(16, 8, 20, 0.5));
    }
    return make_frame(splats, 32, 16, 16);
}

class SmallRunCancel : public ::testing::TestWithParam<bool> {};

TEST_P(SmallRunCancel, ATileThatTerminatesAtOnce) {
    const FrameWorkload frame = opaque_frame();
    DegsConfig config = tiles_of(16);
    config.monitor.cancel = GetParam();
    const auto result = run(config, frame);
    EXPECT_EQ(result->slices(&ArraySlice::Stats::pixels_ended), 512U);
    EXPECT_EQ(result->degs().monitors()[0]->stats().tiles_cancelled, GetParam() ? 2U : 0U);
    std::uint64_t records = 0;
    for (const auto& unit : result->degs().fetchers()) {
        records += unit->stats().records;
    }
    if (GetParam()) {
        EXPECT_LT(records, 1005U); // it takes a while to stop fetching
    } else {
        EXPECT_EQ(records, 2010U);
    }
}

INSTANTIATE_TEST_SUITE_P(OnAndOff, SmallRunCancel, ::testing::Bool());

class SmallRunShapes : public ::testing::TestWithParam<Shape> {};

// The paper's four scaling points (Table III) and crossbars whose two sides differ.
TEST_P(SmallRunShapes, RenderTheReference) {
    const FrameWorkload frame = random_frame(3, 200, 140, GetParam().tile, 250);
    run(test::shaped(exact_arithmetic(), GetParam()), frame);
}

INSTANTIATE_TEST_SUITE_P(Points, SmallRunShapes,
                         ::testing::Values(Shape{16, 1, 4, 4, 4}, Shape{32, 2, 8, 8, 8},
                                           Shape{64, 4, 16, 16, 16}, Shape{128, 8, 32, 32, 32},
                                           Shape{32, 1, 4, 8, 8}, Shape{32, 2, 8, 4, 8},
                                           Shape{32, 2, 6, 4, 8}, Shape{32, 1, 7, 5, 4}));

// More fetchers and Span Units than any internal table would expect.
TEST(SmallRun, TheMostUnitsThatTheKeysAllow) {
    DegsConfig config = tiles_of(64);
    config.sorting.count = 64;
    config.slicing.count = 64;
    config.span.count = 256;
    config.scheduler.banks = 1;
    config.gaussian_buffer.bytes *= 64;
    config.span_buffer.bytes *= 64;
    const FrameWorkload frame = random_frame(4, 130, 70, 64, 100);
    run(config, frame);
}

// 320 segments in a row, 102 400 conflict domains in one bank: neither may be taken for another.
DegsConfig finest_segments() {
    DegsConfig config = tiles_of(32);
    config.tile_size = 320;
    config.scheduler.banks = 1;
    config.scheduler.segment_length = 1;
    config.slicing.skip_dead_rows = true;
    config.pixel_buffer.bytes = 16 * 320 * 320;
    return config;
}

TEST(SmallRun, ADeadSegmentIsNoOtherSegment) {
    std::vector<ProjectedSplat> splats(3, one_pixel(65, 5, 0.98)); // ends the pixel
    splats.resize(300, one_pixel(200, 100, 0.01));                 // until slicing knows
    for (int x = 0; x < 320; ++x) {
        splats.push_back(one_pixel(x, 5));
    }
    const FrameWorkload frame = make_frame(splats, 320, 320, 320);
    run(finest_segments(), frame);
}

// Domains 65 536 apart in cycles that follow each other are no hazard.
TEST(SmallRun, DomainsBeyondSixteenBits) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 20; ++i) {
        splats.push_back(one_pixel(i, 10));        // domain 10 * 320 + i
        splats.push_back(one_pixel(256 + i, 214)); // domain 214 * 320 + 256 + i, 65 536 more
    }
    const FrameWorkload frame = make_frame(splats, 320, 320, 320);
    DegsConfig config = finest_segments();
    config.slicing.skip_dead_rows = false;
    run(config, frame);
}

// Tiles of 16 pixels, 64 of them in flight, ends of tiles by the dozen in one cycle.
TEST(SmallRun, ManyTinyTilesInFlight) {
    DegsConfig config = tiles_of(32);
    config.tile_size = 4;
    config.pixel_buffer.bytes = 16384;
    config.packing.bytes = 8192;
    std::vector<ProjectedSplat> splats;
    for (int y = 1; y < 40; y += 4) {
        splats.push_back(one_row(0, 119, y, 0.4)); // one bank works, the others see ends only
    }
    const FrameWorkload frame = make_frame(splats, 120, 40, 4);
    EXPECT_EQ(config.contexts(), 64);
    run(config, frame);
}

// A bank has long been at work on one tile when the next hundred, of which it has no row, end with
// it in one cycle. The ends take no room of its few packets: if they waited for each other, PE
// slots would be lost until its next tile.
TEST(SmallRun, MoreTilesEndThanPacketsFit) {
    DegsConfig config = exact_arithmetic();
    config.tile_size = 4;
    config.pixel_buffer.bytes = config.pixel_buffer.state_bytes * 16 * 200;
    config.packing.bytes =
        config.scheduler.banks * (config.queue_depth() * config.scheduler.segment_bytes +
                                  4 * config.packing.task_bytes * config.array.pes_per_bank);
    ASSERT_EQ(config.packing_depth(), 4);
    constexpr int kOthers = 100;
    constexpr int kTiles = 120;
    std::vector<ProjectedSplat> splats(250, one_pixel(0, 0, 0.02)); // one per reuse distance
    for (int tile = 1; tile < kTiles; ++tile) {
        const bool other = tile <= kOthers; // a row of another bank
        splats.insert(splats.end(), other ? 1 : 20, one_pixel(4 * tile, other ? 1 : 0, 0.1));
    }
    const FrameWorkload frame = make_frame(splats, 4 * kTiles, 4, 4);
    run(config, frame);
}

// Two frames: the second is projected while the first is rendered, and both are right.
TEST(SmallRun, FramesOverlap) {
    const FrameWorkload first = random_frame(5, 100, 60, 32, 200);
    const FrameWorkload second = random_frame(6, 70, 90, 32, 150);
    const DegsConfig config = tiles_of(32);
    const DegsRun both("both", config, {&first, &second});
    const DegsRun alone("alone", config, {&first});
    const DegsRun other("other", config, {&second});
    sc_core::sc_start();
    test::expect_sound(both);
    test::expect_reference(both);
    EXPECT_TRUE(test::same_bytes(both.image(0), alone.image()));
    EXPECT_TRUE(test::same_bytes(both.image(1), other.image()));
    EXPECT_LT(both.degs().finished(), alone.degs().finished() + other.degs().finished());
    EXPECT_GT(both.degs().finished(), std::max(alone.degs().finished(), other.degs().finished()));
}

// Whatever the data path's formats, the schedule keeps order per pixel: the image depends on the
// arithmetic alone, not on the number of PEs, buffers or scans.
TEST(SmallRun, TheImageDoesNotDependOnTheSchedule) {
    const FrameWorkload frame = random_frame(7, 96, 64, 32, 200);
    DegsConfig config;
    const DegsRun one("one", config, {&frame});
    config.scheduler.scan = DomainScan::Deepest;
    config.scheduler.termination = TerminationGrain::Pixel;
    config.array.pes_per_bank = 4;
    config.scheduler.banks = 4;
    config.memory.bandwidth_gb_per_s = 2;
    config.slicing.skip_dead_rows = true;
    const DegsRun two("two", config, {&frame});
    sc_core::sc_start();
    EXPECT_NE(one.degs().finished(), two.degs().finished());
    EXPECT_TRUE(test::same_bytes(one.image(), two.image()));
}

} // namespace
} // namespace degs
