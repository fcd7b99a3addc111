// SPDX-License-Identifier: Apache-2.0
// The Slicing Units of an estimate against dates worked out by hand.
#include "modules/degs/analytic_slicing.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

constexpr int kRows = 64; // of a tile

AnalyticSlicing slicing_of(int units, std::size_t rows_per_cycle, double date = 0) {
    AnalyticSlicing slicing(units, 1, kRows);
    slicing.begin_tile(date, rows_per_cycle);
    return slicing;
}

/// A splat with the rows from `first` to `last`; returns when the last one is sent.
double slice(AnalyticSlicing& slicing, double arrived, int first, int last) {
    slicing.begin(arrived);
    double sent = 0;
    for (int row = first; row <= last; ++row) {
        sent = slicing.send(row);
    }
    slicing.end();
    return sent;
}

TEST(AnalyticSlicing, SendsSoManyRowsPerCycle) {
    AnalyticSlicing slicing = slicing_of(1, 4);
    EXPECT_EQ(slice(slicing, 0, 0, 3), 0);
    EXPECT_EQ(slice(slicing, 0, 0, 8), 1 + 2) << "nine rows take three cycles";
    EXPECT_EQ(slicing.done(), 4);
}

TEST(AnalyticSlicing, WaitsForTheSplatAndForTheTile) {
    AnalyticSlicing slicing = slicing_of(2, 4, 7);
    EXPECT_EQ(slicing.begin(3), 7);
    slicing.end();
    EXPECT_EQ(slicing.begin(20.5), 21) << "at the next cycle";
    EXPECT_EQ(slicing.send(0), 21);
}

// Splats that a unit sends in one cycle do not hold up the others.
TEST(AnalyticSlicing, UnitsWorkSideBySide) {
    AnalyticSlicing slicing = slicing_of(2, 4);
    EXPECT_EQ(slice(slicing, 0, 0, 3), 0);
    EXPECT_EQ(slice(slicing, 0, 40, 43), 0);
    EXPECT_EQ(slice(slicing, 0, 0, 3), 1);
    EXPECT_EQ(slice(slicing, 0, 0, 3), 1);
}

// The older splat is at row 4 in cycle 1 and over in cycle 3. The younger one sends what lies above
// at once, and what lies below behind it.
TEST(AnalyticSlicing, NeverOvertakesAnOlderSplat) {
    AnalyticSlicing slicing = slicing_of(3, 4);
    EXPECT_EQ(slice(slicing, 0, 0, 15), 3);
    slicing.begin(0);
    EXPECT_EQ(slicing.send(2), 0);
    EXPECT_EQ(slicing.send(5), 1) << "with the older splat, in the same cycle";
    EXPECT_EQ(slicing.send(50), 3) << "below its last row, when it is over";
    EXPECT_EQ(slicing.end(), 4) << "cycles in the unit, most of which it waits";
    EXPECT_EQ(slice(slicing, 0, 20, 21), 3) << "older splats have sent row 5, but not row 50";
}

TEST(AnalyticSlicing, AFullLaneStopsAllUnits) {
    AnalyticSlicing slicing = slicing_of(2, 4);
    slicing.begin(0);
    EXPECT_EQ(slicing.send(10), 0);
    slicing.stall(9);
    EXPECT_EQ(slicing.send(11), 9);
    slicing.end();
    EXPECT_EQ(slice(slicing, 0, 0, 0), 9);
    EXPECT_EQ(slicing.begin(0), 10);
}

} // namespace
} // namespace degs
