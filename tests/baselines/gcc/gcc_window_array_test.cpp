// SPDX-License-Identifier: Apache-2.0
// Stage IV of GCC: slots and dates against closed forms.
#include "tests/baselines/gcc/gcc_array_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::GccArrayBench;
using test::make_frame;
using test::make_splat;
using test::one_pixel;
using test::one_row;
using Options = GccArrayBench::Options;

Options windows_of(int side, int discovery = 1) {
    Options options;
    options.array.window = side;
    options.array.discovery_cycles = discovery;
    return options;
}

std::unique_ptr<GccArrayBench> run(const FrameWorkload& frame, const Options& options) {
    auto bench = std::make_unique<GccArrayBench>("bench", frame, options);
    sc_core::sc_start();
    test::expect_sound(*bench);
    return bench;
}

/// Pixels (i, i) and nothing else: their neighbours are 0.7 px off the axis, the rim is 0.5.
ProjectedSplat diagonal(double centre, double half_length) {
    const double reach = std::sqrt(2 * std::log(0.5 * 255));
    return make_splat(centre, centre, half_length / reach, 0.5 / reach, std::acos(-1.0) / 4, 0.5);
}

class GccArray : public ::testing::TestWithParam<int> {};

// Every window of the view once, whatever side it has: ceil(70 / w) ceil(50 / w) slots per splat.
TEST_P(GccArray, AFullViewTakesEveryWindowOnce) {
    const int side = GetParam();
    const FrameWorkload frame =
        make_frame(std::vector<ProjectedSplat>(6, blanket(30, 20, 100, 0.1)), 70, 50, 128);
    const auto bench = run(frame, windows_of(side));
    const auto slots =
        6 * static_cast<std::uint64_t>((70 + side - 1) / side * ((50 + side - 1) / side));
    EXPECT_EQ(bench->stats().windows, slots);
    EXPECT_EQ(bench->stats().window.cycles(), slots);
    EXPECT_EQ(bench->stats().slots[Slot::Useful], 6U * 70 * 50);
    EXPECT_EQ(bench->stats().slots[Slot::Boundary], slots * bench->pes() - 6 * 70 * 50); // outside
    EXPECT_EQ(bench->stats().extra_seeds, 0U);
}

INSTANTIATE_TEST_SUITE_P(Sides, GccArray, ::testing::Values(4, 8, 16, 32, 2, 5));

// Inside its window: one slot. On a side: the neighbour is probed. In a corner: two neighbours are,
// and the one across the corner is not.
TEST(GccArrayPixels, OnePixelTakesItsWindowAndThoseItTouches) {
    const FrameWorkload frame = make_frame(
        {one_pixel(3, 3), one_pixel(7, 3), one_pixel(8, 8), one_pixel(0, 0)}, 32, 32, 32);
    const auto bench = run(frame, windows_of(8));
    EXPECT_EQ(bench->stats().windows, 1U + 2 + 3 + 1);
    EXPECT_EQ(bench->stats().windows_empty, 0U + 1 + 2 + 0);
    EXPECT_EQ(bench->stats().window.cycles(), 7U);
    EXPECT_EQ(bench->stats().slots[Slot::Useful], 4U);
    EXPECT_EQ(bench->stats().slots[Slot::Boundary], 7U * 64 - 4);
}

// One row inside its row of windows: 32 / 8 slots; on their lower border: as many empty ones.
TEST(GccArrayPixels, ARowTakesItsRowOfWindows) {
    const FrameWorkload frame = make_frame({one_row(0, 31, 3), one_row(0, 31, 7)}, 32, 32, 32);
    const auto bench = run(frame, windows_of(8));
    EXPECT_EQ(bench->stats().windows, 4U + 8);
    EXPECT_EQ(bench->stats().windows_empty, 4U);
    EXPECT_EQ(bench->stats().slots[Slot::Useful], 64U);
}

// A diagonal one pixel wide touches n = 4 windows that share only corners: n seeds, and each of the
// 2 (n - 1) windows beside the corners is probed once.
TEST(GccArrayPixels, ANeedleIsSeededInEveryWindow) {
    const FrameWorkload frame = make_frame({diagonal(12, 40)}, 32, 32, 32);
    const auto bench = run(frame, windows_of(8));
    EXPECT_EQ(bench->stats().windows, 4U + 6);
    EXPECT_EQ(bench->stats().windows_empty, 6U);
    EXPECT_EQ(bench->stats().extra_seeds, 3U);
    EXPECT_EQ(bench->stats().slots[Slot::Useful], 32U);
    EXPECT_EQ(bench->stats().window.cycles(), 10U);
}

// P = 4, by hand: window (1, 1) at 0; its four neighbours, found at 4, at 4..7; nothing else is
// known to follow at 7 + 4. Seed (0, 0) at 11, over at 15. Seed (2, 2) at 15, (2, 3) and (3, 2) at
// 19 and 20, over at 24. Seed (3, 3) at 24: the last of 10 slots.
TEST(GccArrayDiscovery, ANeedleWaitsForWhatItsSlotsFind) {
    const FrameWorkload frame = make_frame({diagonal(12, 40)}, 32, 32, 32);
    const auto bench = run(frame, windows_of(8, 4));
    EXPECT_EQ(bench->stats().windows, 10U);
    EXPECT_EQ(bench->stats().window.cycles(), 25U);
    EXPECT_EQ(bench->stats().slots[Slot::Conflict], 15U * 64);
    // The view is over when that is known: 4 cycles after slot 24, and written back.
    EXPECT_EQ(bench->done()[0].date - bench->stats().window.first, 24U + 4 + 4);
}

// A row of k = 4 windows entered at its end is a chain: 3 P cycles to its last slot, and the next
// splat starts P after that.
TEST(GccArrayDiscovery, ARowIsAChain) {
    const FrameWorkload frame =
        make_frame(std::vector<ProjectedSplat>(3, one_row(-40, 31, 3)), 32, 32, 32);
    std::vector<std::unique_ptr<GccArrayBench>> benches;
    for (const int p : {1, 4, 8}) {
        benches.push_back(
            std::make_unique<GccArrayBench>("p" + std::to_string(p), frame, windows_of(8, p)));
    }
    sc_core::sc_start();
    for (std::size_t i = 0; i < 3; ++i) {
        const Cycle p = i == 0 ? 1 : 4 * i;
        EXPECT_EQ(benches[i]->stats().windows, 12U);
        EXPECT_EQ(benches[i]->stats().window.cycles(), 11 * p + 1);
        EXPECT_EQ(benches[i]->stats().slots[Slot::Conflict], (11 * p + 1 - 12) * 64);
        test::expect_sound(*benches[i]);
    }
}

// Small splats are never interleaved by P > 1: n of them take (n - 1) P + 1 cycles.
TEST(GccArrayDiscovery, OnePixelSplatsTakeTheLatencyEach) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 50; ++i) {
        splats.push_back(one_pixel(1 + 8 * (i % 4) + i % 5, 3));
    }
    const FrameWorkload frame = make_frame(splats, 32, 32, 32);
    const GccArrayBench fast("fast", frame, windows_of(8, 1));
    const GccArrayBench slow("slow", frame, windows_of(8, 8));
    sc_core::sc_start();
    EXPECT_EQ(fast.stats().window.cycles(), 50U);
    EXPECT_EQ(fast.stats().slots[Slot::Conflict], 0U);
    EXPECT_EQ(slow.stats().window.cycles(), 49U * 8 + 1);
    EXPECT_EQ(slow.stats().slots[Slot::Conflict], 49U * 7 * 64);
}

// m x m windows seeded in a corner are taken diagonal by diagonal. With P = 3 the array waits twice
// behind the corner, once behind the diagonal of two and once before the opposite corner; in
// between the frontier holds at least P windows. m = 3 by hand: slots 0, 3 4, 6 7 8, 9 10, 12.
TEST(GccArrayDiscovery, AWideFrontierHidesTheLatency) {
    const FrameWorkload small = make_frame({blanket(-1, -1, 200, 0.1)}, 24, 24, 128);
    const FrameWorkload large = make_frame({blanket(-1, -1, 200, 0.1)}, 128, 128, 128);
    const GccArrayBench three("three", small, windows_of(8, 3));
    const GccArrayBench sixteen("sixteen", large, windows_of(8, 3));
    sc_core::sc_start();
    EXPECT_EQ(three.stats().window.cycles(), 9U + 4);
    EXPECT_EQ(sixteen.stats().window.cycles(), 256U + 4);
    EXPECT_EQ(sixteen.stats().slots[Slot::Conflict], 4U * 64);
}

// Radius 7 around (28, 4). Left view: columns 21..31, rows 0..11, windows (0..1, 2..3). Right view:
// columns 32..35, entered at row 4 in window (0, 0); row 8 is valid in window (1, 0).
TEST(GccArrayViews, ACentreBesideTheViewIsClamped) {
    const double reach = std::sqrt(2 * std::log(0.5 * 255));
    const FrameWorkload frame =
        make_frame({make_splat(28, 4, 7.01 / reach, 7.01 / reach, 0, 0.5)}, 64, 32, 32);
    const auto bench = run(frame, windows_of(8));
    EXPECT_EQ(bench->stats().splats, 2U);
    EXPECT_EQ(bench->stats().windows, 4U + 2);
    EXPECT_EQ(bench->stats().windows_empty, 0U);
    EXPECT_EQ(bench->stats().extra_seeds, 0U);
}

// Pixels (i, i) of a centre in the first view; the second on the diagonal holds 32..47 in windows
// (0, 0), where the clamped centre is, and (1, 1), which shares a corner with it only.
TEST(GccArrayViews, EachViewIsTraversedOnItsOwn) {
    const FrameWorkload frame = make_frame({diagonal(4, 100)}, 48, 48, 32);
    const auto bench = run(frame, windows_of(8));
    EXPECT_EQ(bench->stats().splats, 2U);
    EXPECT_EQ(bench->stats().windows, 10U + 4);
    EXPECT_EQ(bench->stats().extra_seeds, 3U + 1);
    EXPECT_EQ(bench->stats().slots[Slot::Useful], 48U);
}

// Pixels (12 - y, y) of a centre above the view at (20, -8): the clamped centre (20, 0) lies in
// window (0, 2), which is empty. Seeded again in (0, 0), which leads to (0, 1) and (1, 0).
TEST(GccArrayViews, AClampedCentreMayMiss) {
    ProjectedSplat splat = diagonal(20, 100);
    splat.mu_y = -8;
    splat.cov_b = -splat.cov_b;
    const FrameWorkload frame = make_frame({splat}, 32, 32, 32);
    const auto bench = run(frame, windows_of(8));
    EXPECT_EQ(bench->stats().windows, 4U);
    EXPECT_EQ(bench->stats().windows_empty, 1U);
    EXPECT_EQ(bench->stats().extra_seeds, 1U);
    EXPECT_EQ(bench->stats().slots[Slot::Useful], 13U);
}

/// Ends every pixel: alpha 0.99 clamp, T = 1e-2, 1e-4, and the third is refused.
std::vector<ProjectedSplat> opaque(std::size_t behind) {
    std::vector<ProjectedSplat> splats(3, blanket(8, 8, 1e4, 1.0));
    splats.resize(3 + behind, blanket(8, 8, 100, 0.5));
    return splats;
}

// The view is over with its third splat: what follows is dropped and costs nothing.
TEST(GccArrayEnds, AViewThatHasEndedDropsTheRest) {
    const FrameWorkload frame = make_frame(opaque(500), 32, 32, 32);
    Options options = windows_of(8);
    options.listeners = 1;
    options.chunk = 503; // all of them in one hand-over
    const auto bench = run(frame, options);
    EXPECT_EQ(bench->stats().windows, 3U * 16);
    EXPECT_EQ(bench->stats().splats, 3U);
    EXPECT_EQ(bench->stats().splats_dropped, 500U);
    EXPECT_EQ(bench->stats().window.cycles(), 48U);
    EXPECT_EQ(bench->stats().slots[Slot::Useful], 2U * 1024);
    EXPECT_EQ(bench->stats().slots[Slot::Terminated], 1024U);
    EXPECT_EQ(bench->stats().pixels_ended, 1024U);
    // The last pixel ends in slot 47 and is written back, and reported, 4 cycles later.
    const Cycle first = bench->stats().window.first;
    ASSERT_EQ(bench->states().size(), 1U);
    EXPECT_TRUE(bench->states()[0].report.all_ended);
    EXPECT_EQ(bench->states()[0].date, first + 47 + 4);
    EXPECT_EQ(bench->done()[0].date, first + 48 + 4);
    // One block of 8 x 8 px per slot of the third splat.
    ASSERT_EQ(bench->blocks().size(), 16U);
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(bench->blocks()[i].first, first + 32 + i + 4);
    }
}

struct SkipCase {
    int skip, discovery;
};
std::ostream& operator<<(std::ostream& out, const SkipCase& c) {
    return out << "skip_" << c.skip << "_discovery_" << c.discovery;
}
class GccArraySkip : public ::testing::TestWithParam<SkipCase> {};

// A view of four windows in a row. Three opaque splats on each pixel of window 1 end it: 3 x 64
// slots, and 3 x 16 more where the pixel is on a side that the next window shares; P cycles each.
// Rows of pixels that enter in window 0 behind it: slot, ended window at P, known P - 1 after its
// skip, slot, slot P later, over P later.
TEST_P(GccArraySkip, AnEndedWindowCostsItsSkipAndLeadsOn) {
    const auto skip = static_cast<Cycle>(GetParam().skip);
    const auto p = static_cast<Cycle>(GetParam().discovery);
    constexpr Cycle kRows = 10;
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 3 * 64; ++i) {
        splats.push_back(one_pixel(8 + i / 3 % 8, i / 3 / 8, 1.0));
    }
    splats.resize(splats.size() + kRows, one_row(-40, 31, 3, 0.3));
    const FrameWorkload frame = make_frame(splats, 32, 8, 32);
    Options options = windows_of(8, GetParam().discovery);
    options.array.skip_cycles = GetParam().skip;
    const auto bench = run(frame, options);
    const gcc::WindowArray::Stats& s = bench->stats();
    EXPECT_EQ(s.pixels_ended, 64U);
    EXPECT_EQ(s.windows_ended, kRows);
    EXPECT_EQ(s.windows, 240 + 3 * kRows);
    EXPECT_EQ(s.window.cycles(), 240 * p + kRows * (4 * p - 1 + skip) - (p - 1));
    EXPECT_EQ(s.skip_cycles, kRows * skip);
    EXPECT_EQ(s.slots[Slot::Terminated], 64 + kRows * skip * 64); // the third splat of each pixel
    EXPECT_EQ(s.slots[Slot::Useful], 2 * 64 + kRows * 24);
}

INSTANTIATE_TEST_SUITE_P(Cycles, GccArraySkip,
                         ::testing::Values(SkipCase{0, 1}, SkipCase{1, 1}, SkipCase{3, 1},
                                           SkipCase{0, 4}, SkipCase{3, 4}));

} // namespace
} // namespace degs
