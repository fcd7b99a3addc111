// SPDX-License-Identifier: Apache-2.0
// Laws of the cost model on a bill of two blocks, worked out by hand.
#include <stdexcept>

#include <gtest/gtest.h>

#include "cost/run_energy.hpp"

namespace degs::cost {
namespace {

/// 2 of 4 units of 1 mm2 and 1 W, and half of a buffer of 0.5 mm2 and 0.105 W; 10 mW per mm2 leak.
BillOfMaterials bill_of(const Technology& technology, double clock_ghz = 1) {
    BillOfMaterials bill(technology, clock_ghz);
    bill.add_units({"unit", "Units.", true}, UnitRow(1, 1, 4), 2);
    bill.add_sram({"buffer", "A buffer."}, SramRow(0.5, 0.105, 2048, 10), 1024, 5);
    return bill;
}

RunFacts facts_of(double operations, double bytes) {
    RunFacts facts;
    facts.activity = {{"buffer", bytes}, {"unit", operations}};
    facts.seconds = 1e-3;
    facts.frames = 2;
    facts.pixels = 1000;
    facts.dram_nj = 500;
    return facts;
}

TEST(BillOfMaterials, FollowsItsRows) {
    const BillOfMaterials bill = bill_of({});
    EXPECT_DOUBLE_EQ(bill.block("unit").area_mm2, 0.5);
    EXPECT_DOUBLE_EQ(bill.block("buffer").area_mm2, 0.25);
    EXPECT_DOUBLE_EQ(bill.area_mm2(), 0.75);
    EXPECT_DOUBLE_EQ(bill.sram_mm2(), 0.25);
    EXPECT_EQ(bill.sram_bytes(), 1024);
    EXPECT_DOUBLE_EQ(bill.leakage_w(), 0.0075);
    // 0.99 W of four units, 0.1 W of ten bytes per cycle, at 1 GHz.
    EXPECT_NEAR(bill.block("unit").energy_pj, 247.5, 1e-9);
    EXPECT_NEAR(bill.block("buffer").energy_pj, 10, 1e-9);
    EXPECT_NEAR(bill.power_w(), 0.5 + 0.0525, 1e-9);
    EXPECT_THROW(bill.block("other"), std::logic_error);
}

TEST(BillOfMaterials, ClockScalesWhatIsDynamic) {
    EXPECT_NEAR(bill_of({}, 2).power_w(), 2 * (0.5525 - 0.0075) + 0.0075, 1e-9);
}

TEST(BillOfMaterials, ReferenceActivityMakesOperationsDearer) {
    Technology technology;
    technology.activity = 0.5;
    EXPECT_NEAR(bill_of(technology).block("unit").energy_pj, 2 * 247.5, 1e-9);
    EXPECT_NEAR(bill_of(technology).power_w(), bill_of({}).power_w(), 1e-9); // power of the rows
}

TEST(BillOfMaterials, AnotherNodeIsAFactor) {
    Technology technology;
    technology.area_factor = 0.5;
    technology.energy_factor = 0.25;
    technology.leakage_factor = 2;
    const BillOfMaterials bill = bill_of(technology);
    EXPECT_DOUBLE_EQ(bill.area_mm2(), 0.75 / 2);
    EXPECT_NEAR(bill.block("unit").energy_pj, 247.5 / 4, 1e-9);
    EXPECT_NEAR(bill.block("buffer").energy_pj, 10.0 / 4, 1e-9);
    EXPECT_DOUBLE_EQ(bill.leakage_w(), 0.0075 * 2);
}

TEST(BillOfMaterials, BanksAndPortsCountWhereTheyAreLimited) {
    const auto area = [](const SramShape& shape) {
        BillOfMaterials bill({}, 1);
        const PortedSramRow row({1, 1, 1024, 1}, 2, 4);
        bill.add_sram({"buffer", "A buffer."}, row, 1024, 1, shape);
        return bill.area_mm2();
    };
    EXPECT_DOUBLE_EQ(area({0, 8}), 1); // of no design that is known
    EXPECT_DOUBLE_EQ(area({2, 4}), 1);
    EXPECT_DOUBLE_EQ(area({2, 8}), 1.2);
    EXPECT_DOUBLE_EQ(area({2, 2}), 0.9);
    EXPECT_DOUBLE_EQ(area({1, 4}), 1 / 1.75);
    EXPECT_DOUBLE_EQ(area({3, 4}), 2.5 / 1.75);
}

TEST(RunEnergy, IsActivityLeakageAndMemory) {
    const RunEnergy energy(bill_of({}), facts_of(1000, 400));
    EXPECT_NEAR(energy.blocks()[0].dynamic_nj, 247.5, 1e-9);
    EXPECT_NEAR(energy.blocks()[0].leakage_nj, 0.005 * 1e-3 * 1e9, 1e-6);
    EXPECT_NEAR(energy.blocks()[1].dynamic_nj, 4, 1e-9);
    EXPECT_NEAR(energy.total_nj(), 247.5 + 4 + 7500 + 500, 1e-6);
    EXPECT_NEAR(*energy.nj_per_frame(), energy.total_nj() / 2, 1e-9);
    EXPECT_NEAR(*energy.nj_per_pixel(), energy.total_nj() / 1000, 1e-9);
    EXPECT_NEAR(*energy.average_power_w(), energy.total_nj() * 1e-9 / 1e-3, 1e-12);
}

TEST(RunEnergy, TwiceTheActivityIsTwiceTheDynamicEnergy) {
    const RunEnergy once(bill_of({}), facts_of(1000, 400));
    const RunEnergy twice(bill_of({}), facts_of(2000, 800));
    EXPECT_DOUBLE_EQ(twice.dynamic_nj(), 2 * once.dynamic_nj());
    EXPECT_DOUBLE_EQ(twice.leakage_nj(), once.leakage_nj());
    EXPECT_EQ(twice.dram_nj(), once.dram_nj());
    for (std::size_t i = 0; i < once.blocks().size(); ++i) {
        EXPECT_DOUBLE_EQ(twice.blocks()[i].dynamic_nj, 2 * once.blocks()[i].dynamic_nj);
    }
}

TEST(RunEnergy, EveryBlockNeedsExactlyOneActivity) {
    const BillOfMaterials bill = bill_of({});
    RunFacts facts = facts_of(1, 1);
    facts.activity.pop_back();
    EXPECT_THROW(RunEnergy(bill, facts), std::logic_error);
    facts = facts_of(1, 1);
    facts.activity.push_back({"unit", 1});
    EXPECT_THROW(RunEnergy(bill, facts), std::logic_error);
    facts = facts_of(1, 1);
    facts.activity.push_back({"unit", 0}); // the sum of energies is right
    EXPECT_THROW(RunEnergy(bill, facts), std::logic_error);
    facts = facts_of(1, 1);
    facts.activity.push_back({"stranger", 1});
    EXPECT_THROW(RunEnergy(bill, facts), std::logic_error);
}

TEST(RunEnergy, AFrontEndThatWasNotBuiltHasNone) {
    RunFacts facts = facts_of(0, 400);
    facts.array_only = true;
    facts.activity.pop_back();
    facts.dram_nj.reset();
    const RunEnergy energy(bill_of({}), facts);
    ASSERT_EQ(energy.blocks().size(), 1U);
    EXPECT_NEAR(energy.total_nj(), 4 + 2500, 1e-6);
}

TEST(RunEnergy, NothingIsDividedByNothing) {
    RunFacts facts = facts_of(0, 0);
    facts.seconds = 0;
    facts.frames = facts.pixels = 0;
    facts.dram_nj.reset();
    const RunEnergy energy(bill_of({}), facts);
    EXPECT_EQ(energy.total_nj(), 0);
    EXPECT_FALSE(energy.nj_per_frame());
    EXPECT_FALSE(energy.nj_per_pixel());
    EXPECT_FALSE(energy.average_power_w());
}

} // namespace
} // namespace degs::cost
