// SPDX-License-Identifier: Apache-2.0
// The dates at which a bank packs what it has chosen `select_cycles` before. A domain of these
// banks is a row.
#include "tests/modules/degs/scheduler/scheduler_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::one_row;
using test::SchedulerBench;
using Issues = std::vector<std::pair<int, Cycle>>; // rows and cycles

class SelectCycles : public ::testing::TestWithParam<int> {};

// A segment is chosen in the cycle in which it is cut.
TEST_P(SelectCycles, DelayTheFirstSegment) {
    SchedulerBench::Sizes sizes;
    sizes.select_cycles = GetParam();
    SchedulerBench bench(sizes, {one_row(0, 15, 3)});
    const auto issue = 37 + static_cast<Cycle>(GetParam());
    EXPECT_EQ(bench.run_and_list_issues({{37, 0, 3}}), (Issues{{3, issue}}));
    EXPECT_EQ(bench.stats().window.first, issue + 2);
}

// The pixels of a row may be touched again four cycles after an update that executes two cycles
// after it has been packed. The next segment is chosen for the date of the cycle after the choice,
// so that only more than one cycle of selection lengthens the distance.
TEST_P(SelectCycles, LengthenTheDistanceByAllButOne) {
    SchedulerBench::Sizes sizes;
    sizes.select_cycles = GetParam();
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(4, one_row(0, 15, 3, 0.1)));
    const Issues issues =
        bench.run_and_list_issues({{10, 0, 3}, {10, 1, 3}, {10, 2, 3}, {10, 3, 3}});
    const auto cycles = static_cast<Cycle>(GetParam());
    const Cycle more = cycles == 0 ? 0 : cycles - 1;
    const Cycle first = 10 + cycles, distance = 4 + more;
    EXPECT_EQ(issues, (Issues{{3, first},
                              {3, first + distance},
                              {3, first + 2 * distance},
                              {3, first + 3 * distance}}));
    EXPECT_EQ(bench.packing.idle()[Slot::Conflict], 3 * 3 * 16U);
    EXPECT_EQ(bench.packing.idle()[Slot::Starved], 3 * more * 16);
    EXPECT_EQ(bench.accounted(), bench.window_slots());
}

INSTANTIATE_TEST_SUITE_P(Numbers, SelectCycles, ::testing::Values(0, 1, 2, 3, 8));

class FewSelectCycles : public SelectCycles {};

// As long as other rows are ready, the array has a full packet in every cycle.
TEST_P(FewSelectCycles, CostNothingWhileOtherDomainsAreReady) {
    SchedulerBench::Sizes sizes;
    sizes.select_cycles = GetParam();
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(3, blanket(8, 8, 16, 0.1)));
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t splat = 0; splat < 3; ++splat) {
        for (int row = 0; row < 16; ++row) {
            feeds.push_back({10, splat, row});
        }
    }
    bench.run(feeds);
    EXPECT_EQ(bench.stats().window.first, 12U + static_cast<Cycle>(GetParam()));
    EXPECT_EQ(bench.stats().window.cycles(), 48U);
    EXPECT_EQ(bench.packing.idle().total(), 0U);
    EXPECT_EQ(bench.stats().hazards, 0U);
}

INSTANTIATE_TEST_SUITE_P(Numbers, FewSelectCycles, ::testing::Values(0, 1, 2, 3));

/// Splat i covers row rows[i] of the tile and nothing else.
std::vector<ProjectedSplat> splats_of(const std::vector<int>& rows) {
    std::vector<ProjectedSplat> splats;
    for (const int row : rows) {
        splats.push_back(one_row(0, 15, row, 0.1));
    }
    return splats;
}

// Row 3, which fills a packet, may execute again at one date, and half of row 4 at the next one.
// Picks that see the dates moved by the picks before them go in one cycle. Picks of one date do
// not.
class PicksOfACycle : public ::testing::TestWithParam<std::pair<int, Issues>> {};

TEST_P(PicksOfACycle, HaveOneDateIfTheyAreChosenBefore) {
    const auto& [cycles, issues] = GetParam();
    SchedulerBench::Sizes sizes;
    sizes.select_cycles = cycles;
    const ProjectedSplat row_3 = one_row(0, 15, 3, 0.1), row_4 = one_row(0, 7, 4, 0.1);
    SchedulerBench bench(sizes, {row_3, row_4, row_3, row_4});
    EXPECT_EQ(bench.run_and_list_issues({{10, 0, 3}, {11, 1, 4}, {12, 2, 3}, {12, 3, 4}}), issues);
}

INSTANTIATE_TEST_SUITE_P(
    SelectCycles, PicksOfACycle,
    ::testing::Values(std::pair<int, Issues>(0, {{3, 10}, {4, 11}, {3, 14}, {4, 14}}),
                      std::pair<int, Issues>(1, {{3, 11}, {4, 12}, {3, 15}, {4, 16}})));

// Four rows are chosen at 10 and one at 11. A packet, which is a row, is written per cycle, so that
// the first group is packed from 12 to 15 and nothing is chosen from 12 to 14. Rows 5 and 6 are
// therefore chosen together at 15, in turn, although row 6 came first.
TEST(PickPipeline, HoldsEverythingWhileASegmentHasNoRoom) {
    SchedulerBench::Sizes sizes;
    sizes.select_cycles = 2;
    SchedulerBench bench(sizes, splats_of({0, 1, 2, 3, 4, 6, 5}));
    EXPECT_EQ(
        bench.run_and_list_issues(
            {{10, 0, 0}, {10, 1, 1}, {10, 2, 2}, {10, 3, 3}, {11, 4, 4}, {13, 5, 6}, {14, 6, 5}}),
        (Issues{{0, 12}, {1, 13}, {2, 14}, {3, 15}, {4, 16}, {5, 17}, {6, 18}}));
    EXPECT_EQ(bench.packing.idle().total(), 0U);
}

} // namespace
} // namespace degs
