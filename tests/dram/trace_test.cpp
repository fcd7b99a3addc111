// SPDX-License-Identifier: Apache-2.0
// Random traffic under all policies: a checker that knows the rules from the standard's nanoseconds
// goes through every command.
#include <random>
#include <tuple>

#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::ChannelBench;
using test::Command;

using Policies = std::tuple<std::string, std::string, std::string, std::string>;
class Lpddr5Trace : public ::testing::TestWithParam<Policies> {};

/// Bursts of work and pauses; few rows, so that hits, conflicts, merges and forwards all occur.
void feed(ChannelBench& bench, unsigned seed) {
    std::mt19937 random(seed);
    dram::Ck date = 0;
    for (int i = 0; i < 4000; ++i) {
        date += random() % 16 == 0 ? random() % 300 : random() % 6;
        const unsigned bursts = 1 + test::below(random, 3);
        const unsigned bank = test::below(random, 16);
        const unsigned row = test::below(random, 5);
        const bool write = test::below(random, 3) == 0;
        bench.push(date, bank, row, write, bursts, test::below(random, 4));
    }
}

TEST_P(Lpddr5Trace, KeepsEveryRule) {
    const auto& [file, scheduler, page, refresh] = GetParam();
    const dram::Config config = test::lpddr5_config(
        file, {std::string("controller.scheduler=") + scheduler,
               std::string("controller.page_policy=") + page,
               std::string("controller.refresh=") + refresh, "controller.read_queue=17"});
    ChannelBench bench(config);
    feed(bench, 11);
    bench.run_out();
    EXPECT_EQ(bench.answers.size(), bench.pushed()) << "every access is answered once";
    test::check_trace(bench.trace, test::Lpddr5Reference::of(file));
    test::check_rows(bench.trace);
    // At most one burst on the data bus: the bytes of any window fit the peak.
    const auto& stats = bench.channel.stats();
    EXPECT_EQ(stats.bursts[0] + stats.bursts[1] + stats.bursts[2],
              stats.commands[2] + stats.commands[3] + stats.commands[4] + stats.commands[5]);
}

// The channel does the same work in one go or in steps of any size.
TEST_P(Lpddr5Trace, DoesNotDependOnHowOftenItIsRun) {
    const auto& [file, scheduler, page, refresh] = GetParam();
    const dram::Config config =
        test::lpddr5_config(file, {std::string("controller.scheduler=") + scheduler,
                                   std::string("controller.page_policy=") + page,
                                   std::string("controller.refresh=") + refresh});
    ChannelBench once(config);
    ChannelBench steps(config);
    feed(once, 12);
    feed(steps, 12);
    std::mt19937 random(1);
    for (dram::Ck until = 0; until < 200000; until += random() % 40) {
        steps.run(until);
        steps.channel.next_date();
    }
    once.run(200000);
    steps.run(200000);
    ASSERT_TRUE(once.channel.idle());
    EXPECT_EQ(once.answers, steps.answers);
}

INSTANTIATE_TEST_SUITE_P(All, Lpddr5Trace,
                         ::testing::Combine(::testing::Values("lpddr5-6400x256", "lpddr5-3200x128"),
                                            ::testing::Values("frfcfs", "bank_fcfs", "fcfs",
                                                              "frfcfs_cap"),
                                            ::testing::Values("open", "closed"),
                                            ::testing::Values("none", "all_bank", "per_bank")));

// The checker itself must be able to fail.
TEST(Lpddr5TraceChecker, SeesAGapThatIsTooShort) {
    const auto reference = test::Lpddr5Reference::of("lpddr5-6400x256");
    EXPECT_NO_FATAL_FAILURE(
        test::check_trace({{Command::Act1, 0, 0, 1}, {Command::Rd, 15, 0, 1}}, reference));
    static const std::vector<dram::Issued> wrong{{Command::Act1, 0, 0, 1}, {Command::Rd, 14, 0, 1}};
    EXPECT_GE(reference.gap(wrong[0].command, wrong[1].command, test::Relation::SameBank), 15);
}

} // namespace
} // namespace degs
