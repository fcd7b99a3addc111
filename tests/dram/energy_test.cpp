// SPDX-License-Identifier: Apache-2.0
// Energy of channels that are fed by hand: events and constants of the default part.
#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::ChannelBench;
using test::Command;

constexpr double kBurstBits = 32 * 8;

dram::Energy energy_of(const dram::Config& config, const ChannelBench& bench, dram::Ck elapsed) {
    dram::Energy energy;
    energy.add(config.energy, config.timing, bench.channel, elapsed);
    return energy;
}

std::uint64_t issued(const ChannelBench& bench, Command command) {
    return std::count_if(bench.trace.begin(), bench.trace.end(),
                         [command](const dram::Issued& each) { return each.command == command; });
}

/// Seven reads and five writes, each of a row of its own.
void move_bursts(ChannelBench& bench) {
    for (unsigned i = 0; i < 12; ++i) {
        bench.push(100 + 200 * i, i, 3, i >= 7);
        bench.run_out();
    }
}

class Lpddr5EnergyOf : public ::testing::TestWithParam<const char*> {};

// With closed pages every column command closes its row, which costs nothing beside the activation.
TEST_P(Lpddr5EnergyOf, ABurstIsTheSameForAllPagePolicies) {
    const dram::Config config =
        test::lpddr5_without_refresh({std::string("controller.page_policy=") + GetParam()});
    ChannelBench bench(config);
    move_bursts(bench);
    const bool closed = std::string(GetParam()) == "closed";
    ASSERT_EQ(issued(bench, Command::RdA), closed ? 7U : 0U);
    ASSERT_EQ(issued(bench, Command::WrA), closed ? 5U : 0U);
    const dram::Energy energy = energy_of(config, bench, 10000);
    EXPECT_DOUBLE_EQ(energy.activate_nj, 12 * 1.0);
    EXPECT_DOUBLE_EQ(energy.read_nj, 7 * kBurstBits * 2.75e-3);
    EXPECT_DOUBLE_EQ(energy.write_nj, 5 * kBurstBits * 1.75e-3);
    EXPECT_EQ(energy.refresh_nj, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Pages, Lpddr5EnergyOf, ::testing::Values("open", "closed"));

// Eight refreshes of a pair of banks are one of all sixteen.
TEST(Lpddr5Energy, RefreshesByBankCostAnEighth) {
    const dram::Ck elapsed = 10 * 3125; // 10 tREFI of 3906.25 ns
    for (const bool by_bank : {false, true}) {
        const dram::Config config =
            test::lpddr5_config("lpddr5-6400x256", {std::string("controller.refresh=") +
                                                    (by_bank ? "per_bank" : "all_bank")});
        ChannelBench bench(config);
        bench.run(elapsed);
        const auto refreshes = issued(bench, by_bank ? Command::RefPb : Command::RefAb);
        ASSERT_GE(refreshes, by_bank ? 72U : 9U);
        const double all_banks = static_cast<double>(refreshes) / (by_bank ? 8 : 1);
        EXPECT_DOUBLE_EQ(energy_of(config, bench, elapsed).refresh_nj, 30.0 * all_banks);
    }
}

// No row has ever been open for 1000 CK of 1.25 ns: 22 mW.
TEST(Lpddr5Energy, StandbyWithoutOpenRowsIsTheLower) {
    const dram::Config config = test::lpddr5_without_refresh();
    const ChannelBench bench(config);
    EXPECT_NEAR(energy_of(config, bench, 1000).background_nj, 22e-3 * 1250, 1e-9);
}

TEST(Lpddr5Energy, ChannelsAddUp) {
    const dram::Config config = test::lpddr5_without_refresh();
    ChannelBench first(config), second(config);
    move_bursts(first);
    move_bursts(second);
    dram::Energy both = energy_of(config, first, 10000);
    both.add(config.energy, config.timing, second.channel, 10000);
    const dram::Energy one = energy_of(config, second, 10000);
    for (const dram::EnergyClass& each : dram::kEnergyClasses) {
        EXPECT_DOUBLE_EQ(both.*each.nj, 2 * one.*each.nj) << each.name;
    }
}

} // namespace
} // namespace degs
