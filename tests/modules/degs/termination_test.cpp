// SPDX-License-Identifier: Apache-2.0
// What a bank drops for pixels that have ended, and when.
#include "tests/modules/degs/run_fixture.hpp"
#include "tests/modules/degs/scheduler/scheduler_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::DegsRun;
using test::one_pixel;
using test::one_row;
using test::SchedulerBench;

std::string name_of(TerminationGrain grain) {
    return grain == TerminationGrain::Segment ? "segment"
           : grain == TerminationGrain::Task  ? "task"
                                              : "pixel";
}

struct Feedback {
    int packing_latency, reuse, writeback;
};
std::ostream& operator<<(std::ostream& out, const Feedback& f) {
    return out << "latency" << f.packing_latency << "_reuse" << f.reuse << "_back" << f.writeback;
}
class TerminationOf : public ::testing::TestWithParam<Feedback> {};

// alpha = 0.98: T is 0.02, 4e-4, and the third splat is refused and ends the row. Its report is
// back at e2 + writeback; segment k more is issued at e2 + k reuse - latency, so those issued
// before the report are executed in vain, the others dropped.
TEST_P(TerminationOf, SegmentsBehindTheReportAreDropped) {
    constexpr std::uint64_t kSplats = 20;
    const Feedback f = GetParam();
    SchedulerBench::Sizes sizes;
    sizes.packing_latency = f.packing_latency;
    sizes.reuse = f.reuse;
    sizes.writeback = f.writeback;
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(kSplats, blanket(8, 8, 1e4, 0.98)));
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t i = 0; i < kSplats; ++i) {
        feeds.push_back({10, i, 0});
    }
    bench.run(feeds);
    std::uint64_t executed = 3;
    for (int k = 1; k * f.reuse - f.packing_latency < f.writeback; ++k) {
        ++executed;
    }
    EXPECT_EQ(bench.stats().packets, executed);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 2U * 16);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], (executed - 2) * 16);
    EXPECT_EQ(bench.stats().pixels_ended, 16U);
    EXPECT_EQ(bench.bank.stats().tasks_dropped, (kSplats - executed) * 16);
    EXPECT_EQ(bench.bank.stats().tasks_in, kSplats * 16);
}

INSTANTIATE_TEST_SUITE_P(Delays, TerminationOf,
                         ::testing::Values(Feedback{1, 4, 4}, Feedback{2, 4, 4}, Feedback{4, 4, 4},
                                           Feedback{5, 4, 4}, Feedback{2, 13, 4}, Feedback{3, 4, 1},
                                           Feedback{9, 5, 5}));

/// Three splats end one pixel; six more cover its whole row.
std::vector<SchedulerBench::Feed> end_one_pixel(std::vector<ProjectedSplat>& splats) {
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t i = 0; i < 9; ++i) {
        splats.push_back(i < 3 ? one_pixel(4, 0, 0.98) : one_row(0, 15, 0, 0.1));
        feeds.push_back({i < 3 ? Cycle{10} : Cycle{60}, i, 0});
    }
    return feeds;
}

TEST(SinglePixels, EndedPixelsAreMaskedOut) {
    std::vector<ProjectedSplat> splats;
    const auto feeds = end_one_pixel(splats);
    SchedulerBench::Sizes sizes;
    sizes.grain = TerminationGrain::Pixel;
    SchedulerBench bench(sizes, splats);
    bench.run(feeds);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 2U + 6 * 15);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], 1U);
    EXPECT_EQ(bench.bank.stats().tasks_dropped, 6U);
}

class WholeSegments : public ::testing::TestWithParam<TerminationGrain> {};

TEST_P(WholeSegments, EndedPixelsAmongLiveOnesCostTheirSlots) {
    std::vector<ProjectedSplat> splats;
    const auto feeds = end_one_pixel(splats);
    SchedulerBench::Sizes sizes;
    sizes.grain = GetParam();
    SchedulerBench bench(sizes, splats);
    bench.run(feeds);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 2U + 6 * 15);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], 1U + 6);
    EXPECT_EQ(bench.bank.stats().tasks_dropped, 0U);
}

INSTANTIATE_TEST_SUITE_P(Grains, WholeSegments,
                         ::testing::Values(TerminationGrain::Segment, TerminationGrain::Task),
                         [](const auto& grain) { return name_of(grain.param); });

struct GrainDates {
    TerminationGrain grain;
    Cycle last; ///< execution of the row
    std::uint64_t packets, terminated, dropped;
};
std::ostream& operator<<(std::ostream& out, const GrainDates& dates) {
    return out << name_of(dates.grain);
}
class OwnPixels : public ::testing::TestWithParam<GrainDates> {};

// 13 splats on one pixel, and behind them a splat on its whole row. The third one, at 12 + 2 * 4,
// ends the pixel; its report is back at 24, when the fourth one has been issued for 24. By segments
// all wait their turn: the last of the pixel executes at 12 + 12 * 4, the row at 64. Else the nine
// that are left are dropped from 26 on, four per cycle, and the row goes with the last one at 28
// and executes at 30.
TEST_P(OwnPixels, DecideAtIssue) {
    const GrainDates& expected = GetParam();
    std::vector<ProjectedSplat> splats(13, one_pixel(4, 0, 0.98));
    splats.push_back(one_row(0, 15, 0, 0.1));
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        feeds.push_back({10, i, 0});
    }
    SchedulerBench::Sizes sizes;
    sizes.grain = expected.grain;
    SchedulerBench bench(sizes, splats);
    bench.run(feeds);
    EXPECT_EQ(bench.stats().window.first, 12U);
    EXPECT_EQ(bench.stats().window.last, expected.last);
    EXPECT_EQ(bench.stats().packets, expected.packets);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 2U + 15);
    EXPECT_EQ(bench.stats().slots[Slot::Terminated], expected.terminated);
    EXPECT_EQ(bench.bank.stats().tasks_dropped, expected.dropped);
    EXPECT_EQ(bench.bank.stats().segments_dropped, 0U);
    EXPECT_EQ(bench.accounted(), bench.window_slots());
}

// The fourth splat of an ended pixel enters when the report is long there: it takes no room.
TEST_P(OwnPixels, DecideWhenASegmentIsCut) {
    SchedulerBench::Sizes sizes;
    sizes.grain = GetParam().grain;
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(4, one_pixel(4, 0, 0.98)));
    bench.run({{10, 0, 0}, {10, 1, 0}, {10, 2, 0}, {60, 3, 0}});
    const bool drops = sizes.grain != TerminationGrain::Segment;
    EXPECT_EQ(bench.bank.stats().segments_dropped, drops ? 1U : 0U);
    EXPECT_EQ(bench.bank.stats().segments_issued, drops ? 3U : 4U);
    EXPECT_EQ(bench.stats().window.last, drops ? 20U : 62U);
}

INSTANTIATE_TEST_SUITE_P(Grains, OwnPixels,
                         ::testing::Values(GrainDates{TerminationGrain::Segment, 64, 14, 12, 0},
                                           GrainDates{TerminationGrain::Task, 30, 5, 3, 9},
                                           GrainDates{TerminationGrain::Pixel, 30, 5, 2, 10}),
                         [](const auto& dates) { return name_of(dates.param.grain); });

/// Opaque splats of 5 to 15 pixels in width: most segments are parts of a region, and pixels end
/// soon.
FrameWorkload small_opaque_frame() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 3000; ++i) {
        const double size = 1 + unit(random);
        splats.push_back(test::make_splat(96 * unit(random), 64 * unit(random), size,
                                          size * (1 + unit(random)), 6.3 * unit(random),
                                          0.8 + 0.2 * unit(random)));
    }
    return test::make_frame(splats, 96, 64, 32);
}

// The finer the grain, the less is issued; what is left out are tasks of ended pixels only.
TEST(SmallRunTermination, FinerGrainsIssueLess) {
    const FrameWorkload frame = small_opaque_frame();
    std::vector<std::unique_ptr<DegsRun>> runs;
    for (const auto grain :
         {TerminationGrain::Segment, TerminationGrain::Task, TerminationGrain::Pixel}) {
        DegsConfig config = test::shaped(test::exact_arithmetic(), {32, 2, 8, 8, 8});
        config.scheduler.termination = grain;
        runs.push_back(std::make_unique<DegsRun>("degs" + std::to_string(runs.size()), config,
                                                 std::vector<const FrameWorkload*>{&frame}));
    }
    DegsConfig by_task = test::shaped(test::exact_arithmetic(), {32, 2, 8, 8, 8});
    by_task.scheduler.termination = TerminationGrain::Task;
    const DegsRun strict("strict", by_task, {&frame}, Fidelity::Strict);
    sc_core::sc_start();
    test::expect_same_statistics(*runs[1], strict);
    std::vector<std::uint64_t> executed;
    for (const auto& run : runs) {
        test::expect_sound(*run);
        test::expect_reference(*run);
        executed.push_back(run->slots()[Slot::Useful] + run->slots()[Slot::Terminated]);
    }
    EXPECT_GT(executed[0], executed[1] + executed[1] / 50);
    EXPECT_GT(executed[1], executed[2] + executed[2] / 50);
}

} // namespace
} // namespace degs
