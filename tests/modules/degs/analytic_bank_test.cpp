// SPDX-License-Identifier: Apache-2.0
// The queue of a bank in an estimate against dates worked out by hand.
#include "modules/degs/analytic_bank.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

constexpr double kReuse = 4;

AnalyticBank bank_of(std::size_t depth, DomainScan scan = DomainScan::Oldest) {
    AnalyticBank bank(depth, 4, kReuse, scan);
    bank.begin_tile();
    return bank;
}

TEST(AnalyticBank, IssuesOneAfterTheOther) {
    AnalyticBank bank = bank_of(8);
    for (std::size_t domain = 0; domain < 4; ++domain) {
        EXPECT_EQ(bank.add(0, 0.5, domain), 0);
    }
    EXPECT_EQ(bank.done(), 2);
}

// The last task of a segment executes in the cycle that ends at its end; the domain may be updated
// again `reuse` cycles later, and the PEs idle meanwhile.
TEST(AnalyticBank, WaitsForTheDomain) {
    AnalyticBank bank = bank_of(8);
    bank.add(0, 1, 0);
    bank.add(0, 1, 0);
    bank.begin_tile();
    bank.begin_tile(); // issues what waits
    EXPECT_EQ(bank.done(), kReuse + 1);
}

TEST(AnalyticBank, LetsOtherDomainsGoFirst) {
    AnalyticBank bank = bank_of(8);
    bank.add(0, 1, 0);
    bank.add(0, 1, 0); // may go at 4
    bank.add(0, 1, 1); // at 1
    bank.add(0, 1, 2); // at 2
    bank.begin_tile();
    bank.begin_tile();
    EXPECT_EQ(bank.done(), kReuse + 1);
}

TEST(AnalyticBank, IsFull) {
    AnalyticBank bank = bank_of(2);
    EXPECT_EQ(bank.add(0, 1, 0), 0);
    EXPECT_EQ(bank.add(0, 1, 0), 0);
    EXPECT_EQ(bank.add(0, 1, 0), 0) << "the first one goes at 0";
    EXPECT_EQ(bank.add(0, 1, 0), kReuse) << "the second one goes at 4";
    EXPECT_EQ(bank.add(100, 1, 0), 100) << "all have gone long ago";
}

TEST(AnalyticBank, LosesWhatIsLeftOfAPacketThatNothingJoins) {
    AnalyticBank bank = bank_of(8);
    bank.add(0, 0.25, 0);
    bank.add(10.5, 0.25, 1); // too late for the packet of cycle 10
    bank.add(20, 0.25, 2);
    bank.begin_tile();
    bank.begin_tile();
    EXPECT_EQ(bank.done(), 20.25);
}

// Two domains are ready from 0 on, and the older segment is in the second one.
TEST(AnalyticBank, FollowsTheScanRule) {
    const auto waits_for_second = [](DomainScan scan) {
        AnalyticBank bank = bank_of(2, scan);
        bank.add(0, 3, 1);
        bank.add(0, 1, 0);
        return bank.add(1, 1, 2); // one of them has gone
    };
    EXPECT_EQ(waits_for_second(DomainScan::Oldest), 1);
    EXPECT_EQ(waits_for_second(DomainScan::RoundRobin), 1);
    const auto end = [](DomainScan scan) {
        AnalyticBank bank = bank_of(8, scan);
        bank.add(0, 3, 1);
        bank.add(0, 1, 0);
        bank.add(0.5, 1, 0); // the one that went at 0 decides when this may go
        bank.begin_tile();
        bank.begin_tile();
        return bank.done();
    };
    EXPECT_EQ(end(DomainScan::Oldest), 3 + kReuse + 1);
    EXPECT_EQ(end(DomainScan::RoundRobin), kReuse + 1);
}

} // namespace
} // namespace degs
