// SPDX-License-Identifier: Apache-2.0
// Timelines by hand: the power of a step that the run does not fill, what a unit did for most of a
// step, and maps of a run of several frames.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/degs/config.hpp"
#include "sim/trace/power_trace.hpp"
#include "sim/trace/tile_maps.hpp"
#include "sim/trace/trace_file.hpp"

namespace degs::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// 15 cycles in steps of 10, in which memory was read in the first and written in the second.
AcceleratorResult run_by_hand(double more_nj) {
    constexpr double kNjPerByte = 8e-3;
    const cost::Technology::Dram bus = DegsConfig().cost.dram;
    AcceleratorResult run;
    run.cycles = 15;
    run.timeline.step = 10;
    run.timeline.end = 15;
    run.timeline.counters = {{"memory", "splats read", {1000}},
                             {"memory", "pixels written", {0, 500}}};
    cost::RunFacts facts;
    facts.seconds = 15e-9;
    facts.pixels = 1;
    facts.dram_nj = kNjPerByte * (bus.pj_per_bit * 1000 + bus.write_pj_per_bit * 500) + more_nj;
    run.energy = cost::RunEnergy(cost::BillOfMaterials(DegsConfig().cost, 1), facts);
    return run;
}

/// Power over time is the energy of a step over its length: nJ / 10 ns = 100 mW.
TEST(PowerTrace, IsThatOfTheBytesOfEachStep) {
    DegsConfig config;
    const cost::Technology::Dram bus = config.cost.dram;
    ASSERT_NE(bus.pj_per_bit, bus.write_pj_per_bit) << "else directions cost the same";
    const std::vector<PowerSeries> all = power_of(config, run_by_hand(0));
    ASSERT_EQ(all.size(), 1U);
    EXPECT_NEAR(all[0].mw.at(0), 8e-3 * bus.pj_per_bit * 1000 * 100, 1e-6);
    EXPECT_NEAR(all[0].mw.at(1), 8e-3 * bus.write_pj_per_bit * 500 * 100, 1e-6);
}

TEST(PowerTrace, OfTimeAloneEndsWithTheRun) {
    const std::vector<PowerSeries> none = power_of(DegsConfig(), run_by_hand(0));
    const std::vector<PowerSeries> all = power_of(DegsConfig(), run_by_hand(3));
    EXPECT_NEAR(all.at(0).mw.at(0) - none.at(0).mw.at(0), 200, 1e-6); // 2 of 3 nJ in 10 cycles
    EXPECT_NEAR(all.at(0).mw.at(1) - none.at(0).mw.at(1), 100, 1e-6); // the rest in 5
}

// Half of a step is enough to be called busy, less is not.
TEST(TraceFile, NamesWhatAUnitDidForHalfOfAStep) {
    Trace trace;
    trace.timeline.step = 10;
    trace.timeline.end = 20;
    trace.timeline.tracks = {{"span_0", 1, {{"busy", TimelineState::Kind::Busy, {5, 4}}}}};
    const std::string text = trace_text(trace);
    EXPECT_THAT(text, HasSubstr(R"("name":"busy","ph":"X","pid":2,"tid":0,"ts":0,"dur":0.01,)"
                                R"("args":{"busy":5}})"));
    EXPECT_THAT(text, HasSubstr(R"("name":"idle","ph":"X","pid":2,"tid":0,"ts":0.01,"dur":0.01,)"
                                R"("args":{"busy":4}})"));
}

TEST(TileMaps, AreOfTheFirstFrame) {
    RunResult result;
    result.camera.width = 32;
    result.camera.height = 16;
    result.workload.tile_size = 16;
    result.accelerator.tile_records = {{0, 16, 0, 16, 16, 3, {}}, {1, 16, 0, 16, 16, 9, {}}};
    const TileMaps maps = tile_maps_of(result);
    ASSERT_EQ(maps.maps.front().name, "list_length");
    ASSERT_EQ(maps.maps.front().values.size(), 2U);
    EXPECT_TRUE(std::isnan(maps.maps.front().values[0]));
    EXPECT_EQ(maps.maps.front().values[1], 3);
}

} // namespace
} // namespace degs::sim
