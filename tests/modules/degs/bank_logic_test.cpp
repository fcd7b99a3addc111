// SPDX-License-Identifier: Apache-2.0
// What the widths of a bank cost, and which clock they allow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config_source.hpp"
#include "modules/degs/config.hpp"

namespace degs {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

DegsConfig design(const std::vector<std::string>& keys) {
    DegsConfig config;
    ConfigSource::from_overrides(keys).load(config);
    return config;
}

double area_of(const DegsConfig& config, const char* block) {
    return config.bill().block(block).area_mm2;
}

// The laws of docs/synthesis.md by hand: 16 domains, 2 picks, lists of 32 segments in SRAM, and a
// Packing Unit of 24 lanes for 2 segments of 16 pixels.
TEST(BankLogic, ABankIsTheSumOfItsParts) {
    const double selection = 703.2 * 16 * 2 + 465.1 * 16;
    const double lists = 16 * 11 * (135.7 + 58.9 * 4);
    const double domains = 4790.1 * 16 + 1690.2 * 16 * 2;
    const double reach = (8 + 23) * 16 / 2.0 + 24 * 16; // lanes of 32 pixels
    const double packing = (24 + 8) * 21 * 93.7 + reach * (21 * 3.88 + 149.3);
    const cost::LogicLaws laws;
    EXPECT_NEAR(BankShape().area(laws), selection + lists + domains + packing, 1);
    BankShape flops;
    flops.memory = QueueMemory::FlipFlops;
    const double segments = 32 * (1 + 16 + 5 + 4);
    EXPECT_NEAR(flops.area(laws) - BankShape().area(laws), segments * (135.7 + 58.9 * 4), 1);
    EXPECT_NEAR(BankShape().selection_fo4(laws, 0), 6.80 * 4 + 8.26 * 4, 1e-9);
}

TEST(BankLogic, TheDesignOfTableOneIsItsRow) {
    const DegsConfig config = design({});
    EXPECT_NEAR(area_of(config, "packing"), 0.07, 1e-12);
    EXPECT_NEAR(area_of(config, "packing_buffer"), 0.16, 1e-12);
    const BankShape bank = config.bank_shape();
    EXPECT_EQ(bank.domains, 16); // 4 rows of 2 segments in each of two tiles
    EXPECT_EQ(bank.depth, 32);
}

TEST(BankLogic, AreaFollowsWidthsUnlessTheyAreFree) {
    const std::vector<std::string> wide{"scheduler.issue_width=4",
                                        "scheduler.segments_per_cycle=4"};
    const DegsConfig config = design(wide);
    BankShape shape;
    shape.issued = shape.cut = 4;
    const double ratio = shape.area(config.cost.logic) / BankShape().area(config.cost.logic);
    EXPECT_GT(ratio, 1.5);
    EXPECT_NEAR(area_of(config, "packing"), 0.07 * ratio, 1e-12);
    // Four ports for the 3 KB of segments in 32 KB, where the row has two.
    const double ports = (1 + 0.75 * 3) / (1 + 0.75);
    EXPECT_NEAR(area_of(config, "packing_buffer"), 0.16 * (1 + 3.0 / 32 * (ports - 1)), 1e-12);

    std::vector<std::string> free = wide;
    free.emplace_back("cost.logic.widths=false");
    EXPECT_NEAR(area_of(design(free), "packing"), 0.07, 1e-12);
    EXPECT_NEAR(area_of(design(free), "packing_buffer"), 0.16, 1e-12);
}

TEST(BankLogic, PoolsClustersAndBinnersHaveBlocks) {
    const DegsConfig config =
        design({"span.rows=pool", "clusters=2", "binning.pairs_per_cycle=16"});
    const cost::LogicLaws& laws = config.cost.logic;
    const double taken = 42.5 * (1 + 1) * 8 * 64 + 64.1 * (1 + 8) * 64;   // 1 lane, 8 units
    const double given = 42.5 * (8 + 1) * 16 * 96 + 64.1 * (8 + 16) * 96; // 8 banks, 2 each
    EXPECT_NEAR(area_of(config, "span_crossbar"),
                2 * (taken + given) / laws.pe_area * laws.pe.area_mm2, 1e-9);
    EXPECT_NEAR(area_of(config, "binning"), 8 * 19789.5 / laws.pe_area * laws.pe.area_mm2, 1e-9);
    EXPECT_GT(area_of(config, "cluster_dispatch"), 0);
    EXPECT_THROW(design({}).bill().block("binning"), std::logic_error);
}

// FO4 of the four limits of the default design in a nanosecond of 28 nm, by hand: the loop of a
// pixel has four cycles, the others have one.
TEST(ClockLimits, TheSlowestLogicDecides) {
    constexpr double kPerNs = 40 * 0.81 / 0.67; // 40 at 45 nm
    const auto feasible = [](const std::vector<std::string>& keys) {
        return *design(keys).clock().feasible_ghz();
    };
    constexpr double kRounded = 1e-3; // of the key's four digits
    const double serial = 6.80 * 4 + 8.26 * 4;
    EXPECT_NEAR(feasible({}), kPerNs / serial, kRounded);
    const double packing = 11.4 * 5; // 32 pixels
    EXPECT_NEAR(feasible({"scheduler.select_cycles=2"}), kPerNs / packing, kRounded);
    const double queue = 7.15 * 2 + 5.76 * 5;
    const std::vector<std::string> both{"scheduler.select_cycles=2", "packing.latency_cycles=3"};
    EXPECT_NEAR(feasible(both), kPerNs / queue, kRounded);
    std::vector<std::string> near = both;
    near.insert(near.end(),
                {"pipeline.numbers=paper", "scheduler.reuse_cycles=2", "array.writeback_cycles=2"});
    EXPECT_NEAR(feasible(near), 2 * kPerNs / 102.5, kRounded);
}

TEST(ClockLimits, EachHasTheKeyThatGivesItEnoughCycles) {
    const auto words = [](const std::vector<std::string>& keys) {
        return design(keys).clock().words("28 nm");
    };
    EXPECT_THAT(words({}), HasSubstr("choice of segments 0.8 (scheduler.select_cycles=2)"));
    EXPECT_THAT(words({}), HasSubstr("Packing Unit 0.84 (packing.latency_cycles=3)"));
    EXPECT_THAT(words({}), Not(HasSubstr("loop of a pixel")));
    EXPECT_THAT(words({"scheduler.select_cycles=2"}), Not(HasSubstr("choice of segments")));
    EXPECT_THAT(words({"packing.latency_cycles=3"}), Not(HasSubstr("Packing Unit")));
    const std::vector<std::string> fast{"pipeline.numbers=paper", "clock_ghz=2"};
    EXPECT_THAT(words(fast), HasSubstr("loop of a pixel 1.88 (scheduler.reuse_cycles=5)"));
    // Twice as slow a clock has twice the logic in a cycle.
    EXPECT_THAT(words({"clock_ghz=0.5"}), Not(HasSubstr(":")));
}

} // namespace
} // namespace degs
