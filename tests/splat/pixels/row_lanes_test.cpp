// SPDX-License-Identifier: Apache-2.0
// Rows solved several at once are those of the definition, to the last bit.
#include "splat/pixels/row_lanes.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

using Spans = std::array<RowSpan, 64>;

/// Sets with every order of operations, all ends, and formats whose values leave their range.
std::vector<NumberSet> sets_with_all_orders() {
    std::vector<NumberSet> sets;
    for (const char* name : {"paper", "tuned", "fp16", "fp32", "ideal"}) {
        for (const SpanEnds ends : {SpanEnds::Exact, SpanEnds::Outward, SpanEnds::Slope}) {
            sets.push_back(number_set(name));
            sets.back().ends = ends;
            sets.back().delta = ends == SpanEnds::Outward ? 2 : 0;
        }
    }
    sets.push_back(number_set("paper", {"square=e4m3", "ratio=uq1.4", "edge=q11.2"}));
    sets.push_back(number_set("paper", {"distance=q5.1", "level=uq2.3", "g0=e2m2", "d0=q3.1"}));
    sets.push_back(number_set("tuned", {"vertical=squared", "edge=e5m4", "sqrt.entries=5"}));
    sets.push_back(number_set("paper", {"span_base=vertex", "guard=0.25"}));
    return sets;
}

ProjectedSplat splat_of_any_size(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double minor = std::exp(8 * unit(random) - 1.5); // px
    const double major = minor * std::exp(4 * unit(random) * unit(random));
    return test::make_splat(1000 + 40 * unit(random), 500 + 40 * unit(random), major, minor,
                            6.3 * unit(random), 0.005 + 0.99 * unit(random));
}

/// The share of rows that the lanes left out.
double compare_with_definition(const NumberSet& set, SolveRowsFunction solve,
                               std::uint64_t& drawn) {
    const QuantizedRow row(set);
    const RowNumbers numbers(set);
    std::mt19937 random(11);
    std::uint64_t rows = 0, left_out = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const QuantizedSplat splat = row.record(splat_of_any_size(random));
        RowsToSolve wanted;
        wanted.y = 496 + static_cast<int>(random() % 8);
        wanted.step = 1 + static_cast<int>(random() % 4);
        wanted.count = 1 + static_cast<int>(random() % 64);
        wanted.x_begin = 992;
        wanted.x_end = 1056;
        Spans spans;
        const std::uint64_t unusual = solve(numbers, splat, wanted, spans.data());
        EXPECT_EQ(wanted.count < 64 ? unusual >> wanted.count : 0, 0U);
        for (int i = 0; i < wanted.count; ++i, ++rows) {
            if ((unusual >> i & 1U) != 0) {
                ++left_out;
                continue;
            }
            const RowSpan expected =
                row_span(row.solve(splat, wanted.y + i * wanted.step, wanted.x_begin, wanted.x_end),
                         wanted.x_begin);
            EXPECT_EQ(spans[i].length, expected.length);
            if (expected.length == 0) {
                continue;
            }
            ++drawn;
            EXPECT_EQ(spans[i].x0, expected.x0);
            EXPECT_EQ(spans[i].base, expected.base);
            EXPECT_EQ(spans[i].g0, expected.g0);
            EXPECT_EQ(spans[i].d0, expected.d0);
        }
    }
    return static_cast<double>(left_out) / static_cast<double>(rows);
}

TEST(RowLanes, SolveLikeTheDefinition) {
    for (const SolveRowsFunction solve : solve_rows_variants()) {
        for (const NumberSet& set : sets_with_all_orders()) {
            std::uint64_t drawn = 0;
            const double left_out = compare_with_definition(set, solve, drawn);
            EXPECT_GT(drawn, 400U) << set.name;
            EXPECT_LT(left_out, 0.9) << set.name; // else nothing was compared
            ASSERT_FALSE(HasFailure()) << set.name;
        }
    }
}

// What the lanes leave out costs a row the old way.
TEST(RowLanes, LeaveOutNextToNothingOfTheShippedSets) {
    for (const char* name : {"paper", "tuned"}) {
        std::uint64_t drawn = 0;
        EXPECT_LT(compare_with_definition(number_set(name), solve_rows_function(), drawn), 0.05)
            << name;
    }
}

TEST(RowLanes, SolveRowsOfRecordsThatAreNoNumbers) {
    const NumberSet set = number_set("fp16");
    const QuantizedRow row(set);
    const RowNumbers numbers(set);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double bad : {kInfinity, -kInfinity, std::nan("")}) {
        QuantizedSplat splat = row.record(test::make_splat(16, 16, 5, 3, 0.3, 0.8));
        splat.mean_x = bad;
        Spans spans;
        const RowsToSolve wanted{0, 1, 32, 0, 32};
        const std::uint64_t unusual = solve_rows_function()(numbers, splat, wanted, spans.data());
        for (int i = 0; i < 32; ++i) {
            if ((unusual >> i & 1U) == 0) {
                EXPECT_EQ(spans[i].length == 0, row.solve(splat, i, 0, 32).empty());
            }
        }
    }
}

} // namespace
} // namespace degs
