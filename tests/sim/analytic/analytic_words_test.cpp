// SPDX-License-Identifier: Apache-2.0
// The numbers of an estimate for people and comparisons, of a frame made by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/analytic/analytic_run.hpp"

namespace degs::sim {
namespace {

/// A million cycles of 2 GHz, of which a quarter pass before the first tile.
AnalyticRun half_a_millisecond() {
    AnalyticRun run;
    run.config = default_run_config("degs", {"clock_ghz=2"});
    run.frame.cycles = 1e6;
    run.frame.preparation = 2.5e5;
    run.frame.units = {{"span", 1e5, 3e5}, {"memory", 2e5, 6e5}};
    run.frame.limited_by = "memory";
    return run;
}

TEST(AnalyticWords, UnitsAreBusyBeforeAndAfterTheFirstTile) {
    const std::string text = analytic_text(half_a_millisecond());
    EXPECT_THAT(text, testing::ContainsRegex("span +100 000 +300 000 +40\\.0\n"));
    EXPECT_THAT(text, testing::ContainsRegex("memory +200 000 +600 000 +80\\.0\n"));
    EXPECT_THAT(text, testing::HasSubstr("1 000 000 cycles, 0.500 ms, of which 250 000 before"));
}

TEST(AnalyticWords, MeasuresAreOfTheWholeFrame) {
    const Measures m = measures_of(half_a_millisecond());
    EXPECT_DOUBLE_EQ(m[Measure::LatencyMs].value(), 0.5);
    EXPECT_DOUBLE_EQ(m[Measure::Fps].value(), 2000);
    EXPECT_EQ(m[Measure::PreprocessingCycles], 2.5e5);
}

} // namespace
} // namespace degs::sim
