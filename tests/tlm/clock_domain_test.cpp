// SPDX-License-Identifier: Apache-2.0
#include "tlm/clock_domain.hpp"
#include "tlm/has_process.hpp"

#include <gtest/gtest.h>

#include "tlm/process.hpp"

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

TEST(ClockMapping, LiesWhereTheClockOfAPlatformDoes) {
    ClockMapping mapping(sc_time(1, sc_core::SC_NS));
    const ClockDomain clock(mapping);
    const ClockDomain copy = clock;
    EXPECT_EQ(clock.at(5), sc_time(5, sc_core::SC_NS));
    mapping.follow(sc_time(2, sc_core::SC_NS), sc_time(300, sc_core::SC_PS));
    EXPECT_EQ(copy.period(), sc_time(2, sc_core::SC_NS));
    EXPECT_EQ(copy.at(5), sc_time(10.3, sc_core::SC_NS));
    EXPECT_EQ(copy.half_after(5), sc_time(11.3, sc_core::SC_NS));
    EXPECT_EQ(copy.ceil(sc_core::SC_ZERO_TIME), 0U);
    for (Cycle date = 1; date < 50; ++date) {
        EXPECT_EQ(copy.ceil(copy.at(date)), date);
        EXPECT_EQ(copy.floor(copy.at(date)), date);
        EXPECT_EQ(copy.ceil(copy.at(date) + sc_time::from_value(1)), date + 1);
        EXPECT_EQ(copy.floor(copy.at(date) - sc_time::from_value(1)), date - 1);
    }
    EXPECT_EQ(copy.cycles_of(sc_time(4001, sc_core::SC_PS)), 3U);
}

/// Sleeps to cycle 1000, in whose first half another one hurries.
struct Hurried : sc_core::sc_module {
    explicit Hurried(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {
        DEGS_HAS_PROCESS(Hurried);
        SC_THREAD(sleep);
        SC_THREAD(change);
    }
    void sleep() {
        process.advance_to(1000);
        process.sync();
        woken = sc_core::sc_time_stamp();
    }
    void change() {
        sc_core::wait(sc_time(100.2, sc_core::SC_NS));
        EXPECT_FALSE(mapping.settled());
        mapping.hurry();
        EXPECT_EQ(time.clock.at(100), sc_core::sc_time_stamp());
        EXPECT_EQ(time.clock.at(3),
                  sc_core::sc_time_stamp()); // nothing is in the future that was not
        sc_core::wait(sc_time(5, sc_core::SC_NS));
        EXPECT_TRUE(mapping.settled());
        edge = mapping.resume();
        after = time.clock.floor(edge);
        EXPECT_EQ(time.clock.at(after + 3), edge + sc_time(3, sc_core::SC_NS));
    }
    ClockMapping mapping{sc_time(1, sc_core::SC_NS)};
    Timebase time{ClockDomain(mapping)};
    Process process{time};
    sc_time woken, edge;
    Cycle after = 0;
};

TEST(ClockMapping, HurriesToTheDatesThatProcessesSleepToAndResumesAtAnEdge) {
    Hurried hurried("hurried");
    sc_core::sc_start();
    EXPECT_EQ(hurried.woken, sc_time(100.2, sc_core::SC_NS) + sc_time::from_value(2 * 900));
    EXPECT_EQ(hurried.edge, sc_time(106, sc_core::SC_NS));
    EXPECT_GT(hurried.after, Cycle{100 + 2500}); // later than where it was
}

} // namespace
} // namespace degs
