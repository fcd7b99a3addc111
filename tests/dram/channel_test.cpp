// SPDX-License-Identifier: Apache-2.0
// One channel: latencies and throughputs in closed form, order, batching, refresh.
#include <random>

#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::ChannelBench;
using test::Command;
using test::Lpddr5Reference;

class Lpddr5Latency : public ::testing::TestWithParam<const char*> {
protected:
    dram::Config config(std::vector<std::string> overrides = {}) const {
        overrides.emplace_back("controller.refresh=none");
        return test::lpddr5_config(GetParam(), overrides);
    }
    const Lpddr5Reference reference = Lpddr5Reference::of(GetParam());
    dram::Ck hit() const { return static_cast<dram::Ck>(reference.rl) + 2; }
};
INSTANTIATE_TEST_SUITE_P(Both, Lpddr5Latency,
                         ::testing::Values("lpddr5-6400x256", "lpddr5-3200x128"));

TEST_P(Lpddr5Latency, OfClosedOpenAndConflictingRows) {
    ChannelBench bench(config());
    const auto closed = bench.push(100, 3, 7);
    bench.run_out();
    const auto open = bench.push(1000, 3, 7);
    bench.run_out();
    const auto conflict = bench.push(2000, 3, 8);
    bench.run_out();
    EXPECT_EQ(bench.answers[closed], 100 + hit() + reference.rcd());
    EXPECT_EQ(bench.answers[open], 1000 + hit());
    EXPECT_EQ(bench.answers[conflict], 2000 + hit() + reference.rcd() + reference.rp());
    EXPECT_EQ(bench.channel.stats().bursts, (std::array<std::uint64_t, 3>{1, 1, 1}));
}

TEST_P(Lpddr5Latency, SecondBurstOfABlockIsATccdLater) {
    ChannelBench bench(config());
    const auto half = bench.push(100, 0, 0, false, 2);
    bench.run_out();
    const auto whole = bench.push(1000, 0, 0, false, 3);
    bench.run_out();
    EXPECT_EQ(bench.answers[half], 100 + hit() + reference.rcd());
    EXPECT_EQ(bench.answers[whole], 1000 + hit() + static_cast<dram::Ck>(reference.ccd_l));
}

/// CK from the first to the last answer of `count` accesses that all wait from the start.
dram::Ck span(ChannelBench& bench, int count,
              const std::function<std::pair<unsigned, unsigned>(int)>& at, unsigned bursts = 1) {
    for (int i = 0; i < count; ++i) {
        const auto [bank, row] = at(i);
        bench.push(10, bank, row, false, bursts, static_cast<unsigned>(i) % 32);
    }
    bench.run_out();
    dram::Ck first = dram::kNoDate;
    dram::Ck last = 0;
    for (const auto& [id, date] : bench.answers) {
        first = std::min(first, date);
        last = std::max(last, date);
    }
    return last - first;
}

TEST_P(Lpddr5Latency, RowPingPongInABankTakesTrcEach) {
    ChannelBench bench(config({"controller.scheduler=fcfs"}));
    const dram::Ck all = span(bench, 101, [](int i) { return std::pair(5U, i % 2 + 1U); });
    EXPECT_EQ(all, 100U * static_cast<dram::Ck>(reference.rc()));
}

// A hundred reads wait, a row cycle each. One that comes later waits for those in the queue at
// most.
TEST_P(Lpddr5Latency, UrgentReadsWaitForTheQueueOnly) {
    for (const double share : {0.0, 0.5, 1.0}) {
        dram::Config rows = config({"controller.scheduler=fcfs", "controller.read_queue=16"});
        rows.controller.urgent_share = share;
        for (const bool urgent : {false, true}) {
            ChannelBench bench(rows);
            for (int i = 0; i < 100; ++i) {
                bench.push(10, 5, i % 2 + 1U);
            }
            const dram::Ck asked = 1000;
            bench.run(asked - 1);
            const auto late = bench.push(asked, 5, 3, false, 1, 0, urgent);
            bench.run_out();
            const dram::Ck first = bench.answers[0];
            const auto rc = static_cast<dram::Ck>(reference.rc());
            // The column commands of rows so far; a read leaves the queue with its own.
            const dram::Ck served = (asked - 1 - (first - hit())) / rc + 1;
            const dram::Ck in_queue = share == 0.0 ? 16 : share == 0.5 ? 8 : 1;
            EXPECT_EQ((bench.answers[late] - first) / rc, urgent ? served + in_queue : 100)
                << share << ' ' << urgent;
        }
    }
}

TEST_P(Lpddr5Latency, OneGroupHasHalfTheBus) {
    ChannelBench bench(config());
    const dram::Ck all = span(bench, 401, [](int i) { return std::pair(i % 4 + 0U, 9U); });
    // The first few wait for their rows; in 16B mode there are no groups and no such limit.
    EXPECT_NEAR(static_cast<double>(all), 400.0 * reference.ccd_l, 4.0 * reference.rcd());
}

TEST_P(Lpddr5Latency, GroupsInTurnFillTheBus) {
    ChannelBench bench(config());
    const dram::Ck all = span(bench, 401, [](int i) { return std::pair(i % 4 * 4U, 9U); });
    EXPECT_NEAR(static_cast<double>(all), 800.0, 2.0 * reference.rcd());
}

// With a window of 40 CK and a row per access, four accesses of 32 B per window.
TEST_P(Lpddr5Latency, ActivationsAreLimitedByTheirWindow) {
    ChannelBench bench(config({"timing.faw=40"}));
    const dram::Ck all = span(bench, 401, [](int i) { return std::pair(i * 5 % 16 + 0U, i + 0U); });
    EXPECT_NEAR(static_cast<double>(all), 100.0 * 40, 80);
}

// An access of 64 B with a row of its own: PRE, ACT-1, ACT-2 and two RD on one command per CK.
TEST_P(Lpddr5Latency, RandomRowsAreLimitedByTheCommandBus) {
    ChannelBench bench(config({"timing.faw=4", "timing.rrd=1"}));
    std::mt19937 random(4);
    const dram::Ck all = span(
        bench, 2001,
        [&](int) { return std::pair(test::below(random, 16), test::below(random, 999)); }, 3);
    EXPECT_GE(all, 5U * 2000 - 200);
    EXPECT_LE(all, 5U * 2000 * 12 / 10);
}

TEST_P(Lpddr5Latency, RefreshTakesItsShare) {
    const dram::Config with = test::lpddr5_config(GetParam());
    ChannelBench bench(with);
    const int count = 40000;
    const dram::Ck all =
        span(bench, count, [](int i) { return std::pair(i % 4 * 4U, i / 8000 + 1U); });
    const double share = 2.0 * count / static_cast<double>(all);
    const double ceiling = 1.0 - 1.0 * reference.rfc_ab() / reference.refi();
    EXPECT_LT(share, ceiling);
    EXPECT_GT(share, ceiling - 0.03); // closing and opening the rows again
    EXPECT_NEAR(static_cast<double>(bench.channel.stats().commands[8]),
                static_cast<double>(all) / reference.refi(), 1.0);
}

TEST_P(Lpddr5Latency, PerBankRefreshCostsLess) {
    dram::Ck all[2];
    for (const int kind : {0, 1}) {
        ChannelBench bench(test::lpddr5_config(
            GetParam(),
            {kind == 0 ? "controller.refresh=all_bank" : "controller.refresh=per_bank"}));
        all[kind] = span(bench, 40000, [](int i) { return std::pair(i * 5 % 16 + 0U, 1U); });
        const auto& commands = bench.channel.stats().commands;
        const double expected = static_cast<double>(all[kind]) / reference.refi();
        EXPECT_NEAR(static_cast<double>(commands[8]), kind == 0 ? expected : 0, 1.0);
        EXPECT_NEAR(static_cast<double>(commands[9]), kind == 1 ? 8 * expected : 0, 2.0 + expected);
    }
    EXPECT_LT(all[1], all[0]);
}

dram::Config plain(std::vector<std::string> overrides = {}) {
    overrides.emplace_back("controller.refresh=none");
    return test::lpddr5_config("lpddr5-6400x256", overrides);
}

// Four accesses to one bank: rows 1, 2, 1, 2.
std::vector<std::uint32_t> order_of_answers(const char* scheduler) {
    ChannelBench bench(plain({std::string("controller.scheduler=") + scheduler}));
    bench.push(0, 0, 1);
    bench.push(0, 0, 2);
    bench.push(0, 0, 1);
    bench.push(0, 0, 2);
    bench.push(0, 9, 5); // another bank
    bench.run_out();
    std::vector<std::uint32_t> order(bench.answers.size());
    for (const auto& [id, date] : bench.answers) {
        order[id] = id;
    }
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return bench.answers[a] < bench.answers[b]; });
    return order;
}

TEST(Lpddr5Channel, SchedulersDifferInTheirOrder) {
    EXPECT_EQ(order_of_answers("frfcfs"), (std::vector<std::uint32_t>{0, 2, 4, 1, 3}));
    EXPECT_EQ(order_of_answers("bank_fcfs"), (std::vector<std::uint32_t>{0, 4, 1, 2, 3}));
    EXPECT_EQ(order_of_answers("fcfs"), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
}

// Reads wait for a write batch; the batch goes from the high watermark down to the low one.
TEST(Lpddr5Channel, WritesGoInBatches) {
    ChannelBench bench(plain(
        {"controller.write_queue=20", "controller.write_high=0.5", "controller.write_low=0.2"}));
    for (unsigned i = 0; i < 30; ++i) {
        bench.push(0, i % 16, 0, false, 3, i / 16);
    }
    for (unsigned i = 0; i < 10; ++i) {
        bench.push(50, i, 1, true, 3);
    }
    bench.run(49);
    EXPECT_EQ(bench.channel.stats().drains, 0U);
    bench.run_out();
    std::string kinds; // of accesses, in order
    for (const dram::Issued& issued : bench.trace) {
        kinds += issued.command == Command::Rd ? "r" : issued.command == Command::Wr ? "w" : "";
    }
    const std::size_t first = kinds.find('w');
    const std::size_t end = kinds.find('r', first);
    ASSERT_NE(first, std::string::npos);
    ASSERT_NE(end, std::string::npos);
    EXPECT_GE(std::count(kinds.begin(), kinds.begin() + static_cast<std::ptrdiff_t>(end), 'w'),
              2 * 6 - 1); // ten down to four; the last one's second burst may come later
    EXPECT_EQ(bench.channel.stats().drains, 2U); // the rest when no read waits
}

TEST(Lpddr5Channel, ReadsAreAnsweredFromQueuedWrites) {
    ChannelBench bench(plain({"controller.write_queue=20"}));
    for (unsigned i = 0; i < 8; ++i) { // keeps the channel reading
        bench.push(0, i, 3, false, 3);
    }
    bench.push(1, 9, 4, true, 1, 6);
    const auto whole = bench.push(2, 9, 4, false, 3, 6);
    const auto half = bench.push(2, 9, 4, false, 1, 6);
    const auto other = bench.push(2, 9, 4, false, 1, 7);
    bench.run_out();
    EXPECT_EQ(bench.answers[half], 3U);
    EXPECT_GT(bench.answers[whole], 20U) << "half of it is not in the queue";
    EXPECT_GT(bench.answers[other], 20U);
    EXPECT_EQ(bench.channel.stats().forwarded, 1U);
    EXPECT_EQ(bench.channel.stats().forwarded_bursts, 1U);
}

TEST(Lpddr5Channel, WritesToOnePlaceBecomeOne) {
    ChannelBench bench(plain());
    for (unsigned i = 0; i < 8; ++i) {
        bench.push(0, i, 3, false, 3);
    }
    for (int i = 0; i < 5; ++i) {
        bench.push(1, 9, 4, true, i % 2 == 0 ? 1 : 2, 6);
    }
    bench.run_out();
    EXPECT_EQ(bench.channel.stats().merged, 4U);
    EXPECT_EQ(bench.channel.stats().merged_bursts, 3U) << "the second burst was new once";
    EXPECT_EQ(bench.channel.bursts_left(), 0U);
    EXPECT_EQ(bench.channel.stats().commands[static_cast<std::size_t>(Command::Wr)], 2U);
    EXPECT_EQ(bench.answers.size(), bench.pushed());
}

TEST(Lpddr5Channel, PostedWritesAreAnsweredByTheQueue) {
    for (const bool posted : {true, false}) {
        ChannelBench bench(
            plain({posted ? "controller.posted_writes=true" : "controller.posted_writes=false"}));
        const auto write = bench.push(100, 0, 0, true);
        bench.run_out();
        EXPECT_EQ(bench.answers[write], posted ? 101U : 100U + 15 + 9 + 2);
    }
}

TEST(Lpddr5Channel, ClosedPageClosesBehindTheLastAccess) {
    ChannelBench bench(plain({"controller.page_policy=closed"}));
    bench.push(0, 0, 1);
    bench.push(0, 0, 1);
    bench.run_out();
    const auto next = bench.push(1000, 0, 2);
    bench.run_out();
    EXPECT_EQ(bench.answers[next], 1000U + 15 + 17 + 2);
    EXPECT_EQ(bench.channel.stats().commands[static_cast<std::size_t>(Command::RdA)], 2U);
    EXPECT_EQ(bench.channel.stats().commands[static_cast<std::size_t>(Command::Pre)], 0U);
}

// A copy shows what will happen and leaves the channel as it is.
TEST(Lpddr5Channel, CopiesPredict) {
    ChannelBench bench(plain());
    std::mt19937 random(8);
    for (int i = 0; i < 40; ++i) {
        bench.push(10, test::below(random, 16), test::below(random, 3), test::below(random, 4) == 0,
                   3);
    }
    bench.run(60);
    dram::Channel copy = bench.channel;
    copy.observe({});
    const std::size_t commands = bench.trace.size();
    dram::Outcome outcome;
    while (!copy.idle()) {
        copy.run(copy.next_date(), outcome);
    }
    EXPECT_EQ(bench.trace.size(), commands);
    bench.run_out();
    for (const dram::Answer& answer : outcome.answers) {
        EXPECT_EQ(bench.answers[answer.id], answer.date);
    }
}

} // namespace
} // namespace degs
