// SPDX-License-Identifier: Apache-2.0
#include "tlm/clock_domain.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

using sc_core::sc_time;

TEST(ClockDomain, AWholePeriodPerCycle) {
    const ClockDomain clock(1.0);
    EXPECT_EQ(clock.period(), sc_time(1, sc_core::SC_NS));
    EXPECT_EQ(clock.at(0), sc_core::SC_ZERO_TIME);
    EXPECT_EQ(clock.at(1234567), sc_time(1234567, sc_core::SC_NS));
    EXPECT_EQ(clock.half_after(7), sc_time(7.5, sc_core::SC_NS));
}

// 1/0.7 ns is not a whole number of picoseconds; the rounded period is used everywhere, so dates do
// not drift against each other.
TEST(ClockDomain, APeriodThatIsRounded) {
    for (const double gigahertz : {0.7, 1.3, 3.0, 0.033}) {
        const ClockDomain clock(gigahertz);
        EXPECT_NEAR(clock.period().to_seconds() * 1e12, 1000.0 / gigahertz, 0.5);
        for (const Cycle date : {Cycle{0}, Cycle{1}, Cycle{999}, Cycle{123456789}}) {
            EXPECT_EQ(clock.at(date).value(), date * clock.period().value());
            EXPECT_EQ(clock.ceil(clock.at(date)), date);
            EXPECT_GT(clock.half_after(date), clock.at(date));
            EXPECT_LT(clock.half_after(date), clock.at(date + 1));
        }
    }
}

TEST(ClockDomain, CeilIsTheFirstCycleNotBeforeTheTime) {
    const ClockDomain clock(0.7);
    for (Cycle date = 0; date < 50; ++date) {
        EXPECT_EQ(clock.ceil(clock.at(date) + sc_time::from_value(1)), date + 1);
        EXPECT_EQ(clock.ceil(clock.half_after(date)), date + 1);
        EXPECT_EQ(clock.ceil(clock.at(date + 1) - sc_time::from_value(1)), date + 1);
    }
}

// Adding a latency to kNever must stay later than every date.
TEST(ClockDomain, NeverDoesNotWrap) {
    EXPECT_GT(kNever + kNever, kNever);
    EXPECT_GT(kNever + 1'000'000, kNever);
}

} // namespace
} // namespace degs
