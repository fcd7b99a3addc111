// SPDX-License-Identifier: Apache-2.0
// Which domain a bank issues from. A domain of these banks is a row, or a pixel.
#include <string>
#include <tuple>

#include "tests/modules/degs/scheduler/naive_log.hpp"
#include "tests/modules/degs/scheduler/scheduler_bench.hpp"

namespace degs {
namespace {

using test::one_row;
using test::SchedulerBench;
using Issues = std::vector<std::pair<int, Cycle>>; // domains and cycles

struct Expected {
    DomainScan scan;
    Issues issues;
};

class DomainScans : public ::testing::TestWithParam<Expected> {};

// Rows 2, 1, 3 and 3 again come at once, and one segment goes per cycle. A row waits four cycles
// for its next update.
TEST_P(DomainScans, ChooseAmongReadyRows) {
    SchedulerBench::Sizes sizes;
    sizes.issue_width = 1;
    sizes.scan = GetParam().scan;
    SchedulerBench bench(sizes, {one_row(0, 15, 2, 0.1), one_row(0, 15, 1, 0.1),
                                 one_row(0, 15, 3, 0.1), one_row(0, 15, 3, 0.1)});
    EXPECT_EQ(bench.run_and_list_issues({{10, 0, 2}, {10, 1, 1}, {10, 2, 3}, {10, 3, 3}}),
              GetParam().issues);
}

std::string scan_name(const ::testing::TestParamInfo<Expected>& row) {
    constexpr const char* kNames[] = {"RoundRobin", "Oldest", "Deepest"};
    return kNames[static_cast<int>(row.param.scan)];
}

INSTANTIATE_TEST_SUITE_P(
    Rules, DomainScans,
    ::testing::Values(Expected{DomainScan::RoundRobin, {{1, 10}, {2, 11}, {3, 12}, {3, 16}}},
                      Expected{DomainScan::Oldest, {{2, 10}, {1, 11}, {3, 12}, {3, 16}}},
                      Expected{DomainScan::Deepest, {{3, 10}, {2, 11}, {1, 12}, {3, 14}}}),
    scan_name);

/// A rule, and room for so many segments.
class DomainScansOfManyDomains : public ::testing::TestWithParam<std::tuple<DomainScan, int>> {};

// 4096 domains of a pixel each. With the longer queue, the number of a domain and the order of
// arrival do not fit one key.
TEST_P(DomainScansOfManyDomains, AreThoseOfANaiveBank) {
    SchedulerBench::Sizes sizes;
    sizes.issue_width = 3;
    sizes.segments_per_cycle = 32;
    sizes.segment_length = 1;
    sizes.scan = std::get<0>(GetParam());
    sizes.queue = std::get<1>(GetParam());
    SchedulerBench bench(sizes,
                         {one_row(0, 15, 40, 0.1), one_row(20, 35, 7, 0.1), one_row(4, 19, 40, 0.1),
                          one_row(0, 15, 63, 0.1)},
                         64);
    EventLog log;
    bench.bank.log_to(log);
    bench.run({{10, 0, 40}, {10, 1, 7}, {11, 2, 40}, {12, 3, 63}});
    const auto events = test::events_of(log);
    const auto& facts = log.facts();
    test::NaiveBank naive(test::NaiveFacts({facts.begin(), facts.end()}), events);
    EXPECT_EQ(test::first_difference(test::lines_of(events), naive.run()), "");
    EXPECT_EQ(bench.bank.stats().segments_issued, 64U);
}

INSTANTIATE_TEST_SUITE_P(Rules, DomainScansOfManyDomains,
                         ::testing::Combine(::testing::Values(DomainScan::RoundRobin,
                                                              DomainScan::Oldest,
                                                              DomainScan::Deepest),
                                            ::testing::Values(64, 1 << 20)));

} // namespace
} // namespace degs
