// SPDX-License-Identifier: Apache-2.0
// The dates at which tasks execute, against closed formulas.
#include "tests/modules/degs/scheduler/scheduler_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::one_pixel;
using test::one_row;
using test::SchedulerBench;

class FirstExecution : public ::testing::TestWithParam<int> {};

// Issued in the cycle in which the span enters, executed the packing latency later.
TEST_P(FirstExecution, IsThePackingLatencyAfterTheSpan) {
    SchedulerBench::Sizes sizes;
    sizes.packing_latency = GetParam();
    SchedulerBench bench(sizes, {one_row(0, 15, 3)});
    bench.run({{37, 0, 3}});
    EXPECT_EQ(bench.stats().window.first, 37U + static_cast<Cycle>(GetParam()));
    EXPECT_EQ(bench.stats().window.last, bench.stats().window.first);
    EXPECT_EQ(bench.stats().packets, 1U);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 16U);
    EXPECT_EQ(bench.accounted(), bench.window_slots());
}

// The slice hands its tile over in the cycle after the last packet, and it is written back then.
TEST_P(FirstExecution, TheTileIsDoneWhenItsLastPixelIsWrittenBack) {
    SchedulerBench::Sizes sizes;
    sizes.packing_latency = GetParam();
    sizes.writeback = 3;
    SchedulerBench bench(sizes, {one_row(0, 15, 3)});
    bench.run({{37, 0, 3}});
    EXPECT_EQ(bench.tile_done, std::vector<Cycle>{bench.stats().window.last + 1 + 3});
    EXPECT_EQ(bench.tile_state, bench.tile_done);
}

INSTANTIATE_TEST_SUITE_P(Latencies, FirstExecution, ::testing::Values(1, 2, 5));

class FullTile : public ::testing::TestWithParam<int> {};

// 16 rows of 16 px, one row per cycle: as soon as a packet takes no more than a cycle brings, the
// array never waits; packets = ceil(tasks / width).
TEST_P(FullTile, PacketsAreTasksOverWidth) {
    SchedulerBench::Sizes sizes;
    sizes.width = GetParam();
    SchedulerBench bench(sizes, {blanket(8, 8, 16)});
    bench.run(SchedulerBench::rows(0, 16, 20, 1));
    const auto packets = static_cast<Cycle>((256 + sizes.width - 1) / sizes.width);
    EXPECT_EQ(bench.stats().packets, packets);
    EXPECT_EQ(bench.stats().window.first, 22U);
    EXPECT_EQ(bench.stats().window.cycles(), packets);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], 256U);
    EXPECT_EQ(bench.accounted(), bench.window_slots());
    EXPECT_EQ(bench.stats().hazards, 0U);
}

INSTANTIATE_TEST_SUITE_P(Widths, FullTile, ::testing::Values(1, 3, 8, 15, 16));

class Reuse : public ::testing::TestWithParam<int> {};

// Every splat updates the same pixel: executions are exactly the reuse distance apart, whatever
// waits in the bank.
TEST_P(Reuse, OnePixelSplatsExecuteTheReuseDistanceApart) {
    constexpr std::uint32_t kSplats = 12;
    SchedulerBench::Sizes sizes;
    sizes.reuse = GetParam();
    sizes.writeback = std::min(GetParam(), 4);
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(kSplats, one_pixel(5, 5, 0.1)));
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t i = 0; i < kSplats; ++i) {
        feeds.push_back({10, i, 5});
    }
    bench.run(feeds);
    const auto reuse = static_cast<Cycle>(GetParam());
    EXPECT_EQ(bench.stats().packets, kSplats);
    EXPECT_EQ(bench.stats().window.first, 12U);
    EXPECT_EQ(bench.stats().window.last, 12 + (kSplats - 1) * reuse);
    EXPECT_EQ(bench.stats().slots[Slot::Useful], kSplats);
    EXPECT_EQ(bench.packing.idle()[Slot::Conflict], bench.window_slots() - kSplats - 15);
    EXPECT_EQ(bench.packing.idle().total(), bench.window_slots() - kSplats);
    EXPECT_EQ(bench.stats().hazards, 0U);
}

// A segment over several packets is busy until its last one has executed.
TEST_P(Reuse, CountsFromTheLastPacketOfASegment) {
    SchedulerBench::Sizes sizes;
    sizes.width = 4; // 16 px: four packets
    sizes.reuse = GetParam();
    sizes.writeback = 1;
    SchedulerBench bench(sizes, {one_row(0, 15, 2, 0.1), one_row(0, 15, 2, 0.1)});
    bench.run({{10, 0, 2}, {10, 1, 2}});
    EXPECT_EQ(bench.stats().packets, 8U);
    // 12 .. 15, then 15 + reuse .. 18 + reuse
    EXPECT_EQ(bench.stats().window.last, 18 + static_cast<Cycle>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Distances, Reuse, ::testing::Values(1, 4, 5, 13));

// Other rows fill the cycles between two updates of a row.
TEST(IssueBank, OtherDomainsFillTheGap) {
    SchedulerBench bench({}, std::vector<ProjectedSplat>(3, blanket(8, 8, 16, 0.1)));
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t splat = 0; splat < 3; ++splat) {
        for (int row = 0; row < 4; ++row) {
            feeds.push_back({10, splat, row});
        }
    }
    bench.run(feeds); // 4 rows round: each is back after exactly 4 cycles
    EXPECT_EQ(bench.stats().window.first, 12U);
    EXPECT_EQ(bench.stats().window.cycles(), 12U);
    EXPECT_EQ(bench.packing.idle().total(), 0U);
    EXPECT_EQ(bench.stats().hazards, 0U);
}

// Eight rows wait at the crossbar. The bank cuts four per cycle but takes only as many as the
// crossbar is wide, and the array executes what it gets: a wire for two units halves their rate.
class CrossbarWidth : public ::testing::TestWithParam<std::pair<int, Cycle>> {};

TEST_P(CrossbarWidth, LimitsTheSpansPerCycle) {
    const auto [width, cycles] = GetParam();
    SchedulerBench::Sizes sizes;
    sizes.spans_per_cycle = width;
    sizes.width = 32; // two rows
    SchedulerBench bench(sizes, {blanket(8, 8, 32, 0.2)});
    bench.run(SchedulerBench::rows(0, 8, 10));
    EXPECT_EQ(bench.stats().window.cycles(), cycles);
    EXPECT_EQ(bench.bank.stats().spans, 8U);
}

INSTANTIATE_TEST_SUITE_P(Widths, CrossbarWidth,
                         ::testing::Values(std::pair<int, Cycle>(0, 4), std::pair<int, Cycle>(2, 4),
                                           std::pair<int, Cycle>(1, 8)));

// One context: the second tile's segments wait in the bank until the Pixel Buffer hands it back.
TEST(IssueBank, TheNextTileStartsWhenItsContextIsFree) {
    SchedulerBench bench({}, {blanket(16, 8, 32, 0.2)}, 16, 2);
    bench.next_context = 100;
    std::vector<SchedulerBench::Feed> feeds = SchedulerBench::rows(0, 4, 10);
    for (int row = 0; row < 4; ++row) {
        feeds.push_back({10, 0, row, 1});
    }
    bench.run(feeds);
    EXPECT_EQ(bench.stats().window.first, 12U);
    EXPECT_EQ(bench.stats().window.last, 100U + 2 + 3);
    EXPECT_EQ(bench.packing.idle()[Slot::Blocked], (102U - 16) * 16);
    EXPECT_EQ(bench.accounted(), bench.window_slots());
}

// The queue has room for one segment and is full until the first one's pixels are at rest. The
// Segmenter is empty, so it takes the next span at once.
TEST(IssueBank, TakesASpanAlthoughTheQueueIsFull) {
    SchedulerBench::Sizes sizes;
    sizes.queue = 1;
    sizes.reuse = 20;
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(3, blanket(8, 8, 16, 0.1)));
    EXPECT_EQ(bench.run_and_list_takes({{10, 0, 3}, {12, 1, 3}, {14, 2, 3}}),
              (std::vector<Cycle>{10, 12, 14}));
}

// Twenty splats end columns 16 to 31 of a row, not those before. One segment is cut per cycle, and
// the queue has room for one, which waits for its pixels. The second segment of the span that was
// taken at 1102 has ended and is dropped at 1103, without room, so that the next span is taken at
// 1104.
TEST(IssueBank, DropsTheNextSegmentAlthoughTheQueueIsFull) {
    SchedulerBench::Sizes sizes;
    sizes.queue = 1;
    sizes.segments_per_cycle = 1;
    sizes.reuse = 20;
    const ProjectedSplat wide = test::make_splat(23.5, 3, 6, 0.3, 0, 0.99);
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(23, wide), 32);
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t i = 0; i < 20; ++i) {
        feeds.push_back({10 + Cycle{50} * i, i, 3});
    }
    feeds.push_back({1100, 20, 3});
    feeds.push_back({1102, 21, 3});
    feeds.push_back({1103, 22, 3});
    const std::vector<Cycle> takes = bench.run_and_list_takes(feeds);
    EXPECT_GE(bench.bank.stats().segments_dropped, 3U);
    EXPECT_EQ(std::vector<Cycle>(takes.end() - 3, takes.end()),
              (std::vector<Cycle>{1100, 1102, 1104}));
}

// Room for two packets and a long way from issue to execution: packets in the pipeline take no
// room, so five rows that wait from the start execute one after the other.
class PackingLatency : public ::testing::TestWithParam<int> {};

TEST_P(PackingLatency, TakesNoRoomOfThePackets) {
    SchedulerBench::Sizes sizes;
    sizes.packing_latency = GetParam();
    sizes.packets = 2;
    SchedulerBench bench(sizes, {blanket(8, 8, 16, 0.2)});
    bench.run(SchedulerBench::rows(0, 5, 10));
    EXPECT_EQ(bench.stats().window.first, 10U + static_cast<Cycle>(GetParam()));
    EXPECT_EQ(bench.stats().window.cycles(), 5U);
    EXPECT_EQ(bench.packing.idle().total(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Latencies, PackingLatency, ::testing::Values(2, 3, 6, 8, 12, 20));

// Deep packing buffer, four segments issued per cycle but one executed: whatever queues up drains
// back to back and still keeps its distance. Without scoreboard it does not.
class Hazards : public ::testing::TestWithParam<bool> {};

TEST_P(Hazards, OnlyTheScoreboardPreventsThem) {
    SchedulerBench::Sizes sizes;
    sizes.packets = 64;
    sizes.scoreboard = GetParam();
    constexpr std::uint32_t kSplats = 30;
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(kSplats, blanket(8, 8, 100, 0.05)));
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t i = 0; i < kSplats; ++i) {
        feeds.push_back({10, i, 3});
    }
    bench.run(feeds);
    EXPECT_EQ(bench.stats().packets, kSplats);
    EXPECT_EQ(bench.stats().hazards, GetParam() ? 0U : (kSplats - 1) * 16);
}

INSTANTIATE_TEST_SUITE_P(Scoreboard, Hazards, ::testing::Bool());

// Without scoreboard segments of 16 px execute back to back. In packets of 4 each pixel comes again
// after 4 cycles, when it is just written back, although its segment is never at rest.
TEST(IssueBank, HazardsCountBySinglePixels) {
    constexpr std::uint32_t kSplats = 30;
    std::vector<SchedulerBench::Feed> feeds;
    for (std::uint32_t i = 0; i < kSplats; ++i) {
        feeds.push_back({10, i, 3});
    }
    SchedulerBench::Sizes sizes;
    sizes.width = 4;
    sizes.packets = 64;
    sizes.scoreboard = false;
    SchedulerBench bench(sizes, std::vector<ProjectedSplat>(kSplats, blanket(8, 8, 100, 0.05)));
    bench.run(feeds);
    EXPECT_EQ(bench.stats().window.cycles(), kSplats * 4);
    EXPECT_EQ(bench.stats().hazards, 0U);
}

// Eight rows wait at the crossbar, packets take two of them, and the Packing Buffer's ports let so
// many segments in and out per cycle: one takes twice as long as two. Two are what the array
// executes.
class SegmentPorts : public ::testing::TestWithParam<std::pair<int, Cycle>> {};

TEST_P(SegmentPorts, LimitTheSegmentsPerCycle) {
    const auto [ports, cycles] = GetParam();
    SchedulerBench::Sizes sizes;
    sizes.segment_ports = ports;
    sizes.width = 32; // two rows
    SchedulerBench bench(sizes, {blanket(8, 8, 32, 0.2)});
    bench.run(SchedulerBench::rows(0, 8, 10));
    EXPECT_EQ(bench.stats().window.cycles(), cycles);
    EXPECT_EQ(bench.accounted(), bench.window_slots());
}

INSTANTIATE_TEST_SUITE_P(Ports, SegmentPorts,
                         ::testing::Values(std::pair<int, Cycle>(0, 4), std::pair<int, Cycle>(2, 4),
                                           std::pair<int, Cycle>(1, 8)));

// Four rows of the second tile wait in the bank for its context, long cut, and go together: as many
// per cycle as the ports let out, and the array executes two.
class SegmentReadPorts : public ::testing::TestWithParam<std::pair<int, Cycle>> {};

TEST_P(SegmentReadPorts, LimitWhatIsIssued) {
    const auto [ports, cycles] = GetParam();
    SchedulerBench::Sizes sizes;
    sizes.segment_ports = ports;
    sizes.width = 32;
    SchedulerBench bench(sizes, {blanket(16, 8, 32, 0.2)}, 16, 2);
    bench.next_context = 100;
    std::vector<SchedulerBench::Feed> feeds = SchedulerBench::rows(0, 1, 10);
    for (int row = 0; row < 4; ++row) {
        feeds.push_back({10, 0, row, 1});
    }
    bench.run(feeds);
    EXPECT_EQ(bench.stats().window.last, 100U + 2 + cycles - 1);
    EXPECT_EQ(bench.accounted(), bench.window_slots());
}

INSTANTIATE_TEST_SUITE_P(Ports, SegmentReadPorts,
                         ::testing::Values(std::pair<int, Cycle>(0, 2), std::pair<int, Cycle>(2, 2),
                                           std::pair<int, Cycle>(1, 4)));

// Segments that waited for the read port say so: two wait in the queue, one may go.
TEST(IssueBankPorts, AWaitForTheReadPortHasACauseOfItsOwn) {
    SchedulerBench::Sizes sizes;
    sizes.segment_ports = 1;
    sizes.width = 32;
    sizes.reuse = 20; // two rows at 10, whose next segments wait together until the first may go
    SchedulerBench bench(sizes, {blanket(8, 8, 32, 0.2), blanket(8, 8, 32, 0.2)});
    bench.run({{10, 0, 0}, {11, 0, 1}, {12, 1, 0}, {13, 1, 1}});
    EXPECT_EQ(bench.stats().window.last, 12U + 1 + 20);
    EXPECT_EQ(bench.accounted(), bench.window_slots());
}

// The first row of a splat waits until its parameters have been written, as far as the way from
// issue to execution does not hide it; the second row of the splat follows at once.
class FeatureFillTime : public ::testing::TestWithParam<std::pair<int, Cycle>> {};

TEST_P(FeatureFillTime, DelaysTheFirstRow) {
    const auto [cycles, first] = GetParam();
    SchedulerBench::Sizes sizes;
    sizes.fill_cycles = cycles;
    SchedulerBench bench(sizes, {blanket(8, 8, 32, 0.2)});
    bench.run(SchedulerBench::rows(0, 2, 10));
    EXPECT_EQ(bench.stats().window.first, first);
    EXPECT_EQ(bench.stats().window.last, first + 1);
}

INSTANTIATE_TEST_SUITE_P(Cycles, FeatureFillTime,
                         ::testing::Values(std::pair<int, Cycle>(0, 12),
                                           std::pair<int, Cycle>(2, 12),
                                           std::pair<int, Cycle>(3, 13),
                                           std::pair<int, Cycle>(9, 19)));

} // namespace
} // namespace degs
