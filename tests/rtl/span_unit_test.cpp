// SPDX-License-Identifier: Apache-2.0
// The RTL of a Span Unit against the model, bit by bit.
#include <systemc>
using sc_core::sc_time_stamp; // headers of Verilator want it where SystemC is in use

#include <iostream>
#include <memory>

#include <gtest/gtest.h>

#include "Vroot_1.h"
#include "Vspan_0.h"
#include "Vspan_1.h"

#include "splat/pixels/data_path.hpp"
#include "tests/rtl/hard_operands.hpp"

namespace degs::rtl_test {
namespace {

constexpr int kRandomRows = 1'000'000;

void expect_same(const SpanCounts& counts) {
    EXPECT_EQ(counts.differing_bits, 0U) << counts.first;
    std::cout << counts.operands << " rows, " << counts.spans << " with a span; "
              << counts.differing_operands << " differ, in " << counts.differing_bits << " bits\n";
}

/// Half of the rows are those of frames, half are adversarial.
template <class Rtl>
void compare_random_rows(const char* numbers) {
    const QuantizedRow row(number_set(numbers));
    SpanOperands operands(row, 1);
    SpanBench<Rtl> bench(row);
    ProjectedSplat splat = operands.projected();
    for (int i = 0; i < kRandomRows; ++i) {
        if (i % 16 == 0) {
            splat = operands.projected();
        }
        bench.put(i % 2 == 0   ? operands.row_of(splat)
                  : i % 4 == 1 ? operands.any_record()
                               : operands.edge_of_ellipse());
        if (operands.one_of(16)) {
            bench.pause();
        }
    }
    expect_same(bench.finish());
}

TEST(SpanUnitRtl, SolvesRandomRowsInPaperAsTheModelDoes) {
    compare_random_rows<Vspan_0>("paper");
}

TEST(SpanUnitRtl, SolvesRandomRowsInTunedAsTheModelDoes) {
    compare_random_rows<Vspan_1>("tuned");
}

template <class Rtl>
void compare_hard_rows(const char* numbers) {
    const QuantizedRow row(number_set(numbers));
    HardRows hard(row);
    SpanBench<Rtl> bench(row);
    const auto put = [&bench](const SpanOperand& operand) { bench.put(operand); };
    hard.each_pair_of_fields(put);
    hard.each_edge(put);
    hard.each_place(put);
    hard.each_steepness(put);
    expect_same(bench.finish());
}

TEST(SpanUnitRtl, SolvesHardRowsInPaperAsTheModelDoes) {
    compare_hard_rows<Vspan_0>("paper");
}

TEST(SpanUnitRtl, SolvesHardRowsInTunedAsTheModelDoes) {
    compare_hard_rows<Vspan_1>("tuned");
}

// DataPath::solve_row is the definition that the tests above compare with.
TEST(SpanUnitRtl, DefinitionIsThatOfTheDataPath) {
    for (const char* numbers : {"paper", "tuned"}) {
        const QuantizedRow row(number_set(numbers));
        SpanOperands operands(row, 3);
        FrameWorkload frame;
        for (int i = 0; i < 2000; ++i) {
            frame.splats.push_back(operands.projected());
        }
        const auto path = make_data_path(named_numbers(numbers), 128, 1);
        const std::uint32_t first = path->add_frame(frame);
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const SpanOperand operand = operands.row_of(frame.splats[i]);
            const int end = operand.x_begin + operand.columns;
            const auto span =
                path->solve_row(first + i, operand.y, operand.x_begin, end, operand.y);
            const QuantizedSpan wanted = row.solve(operand.splat, operand.y, operand.x_begin, end);
            ASSERT_EQ(span.has_value(), !wanted.empty());
            if (span) {
                EXPECT_EQ(span->x0 + operand.x_begin, wanted.x0);
                EXPECT_EQ(span->g0, wanted.g0);
                EXPECT_EQ(span->d0, wanted.d0);
            }
        }
    }
}

/// The root of 1 - x / 2^18 in units of 2^-15 before the shift, as docs/numbers.md has it: a value
/// and a part of a rise, each rounded once, ties to even.
struct ExactRoot {
    double root = 0;
    bool tie = false; ///< the part of the rise lies in the middle of two units

    ExactRoot(const LookupTable& table, int x) {
        const auto units = [](float value) { return static_cast<int>(std::ldexp(value, 15)); };
        constexpr int kCell = 6144; // 3/128 of 2^18
        int left = (1 << 18) - x;
        int pairs = 0;
        for (; left != 0 && left < 1 << 16; ++pairs) {
            left <<= 2;
        }
        if (left == 0) {
            return;
        }
        const int place = left - (1 << 16);
        const int cell = std::min(place / kCell, 31);
        const int product = units(table.lane_falls()[cell]) * (place - cell * kCell);
        const int below = product / kCell;
        const int rest = 2 * (product - below * kCell);
        tie = rest == kCell;
        const int part = below + (rest > kCell || (tie && below % 2 == 1) ? 1 : 0);
        root = std::ldexp(units(table.lane_values()[cell]) + part, -15 - pairs);
    }
};

// The root alone, for every x, because spans meet only some of them. The model takes the place in a
// cell, a multiple of 128/3, in double, and so misses some of the ties: 130 of its roots are a unit
// of 2^-15 less than the page says.
TEST(SpanUnitRtl, TakesTheRootOfEveryXInTuned) {
    const LookupTable table(number_set("tuned").sqrt);
    const InTableFolder folder;
    Vroot_1 rtl;
    std::uint64_t differ = 0;
    std::uint64_t model_differs = 0;
    constexpr int kOne = 1 << 18;
    for (int x = 0; x < kOne + 3; ++x) {
        put(rtl.x, std::min(x, kOne));
        rtl.clk = 0;
        rtl.eval();
        rtl.clk = 1;
        rtl.eval();
        if (x >= 2) {
            const int exponent = static_cast<int>(rtl.exponent ^ 0x200U) - 0x200;
            const double root = std::ldexp(static_cast<double>(rtl.mantissa), exponent);
            const ExactRoot exact(table, x - 2);
            differ += root != exact.root ? 1 : 0;
            const bool model = table(std::ldexp(x - 2, -18)) == exact.root;
            EXPECT_TRUE(model || exact.tie) << x - 2;
            model_differs += model ? 0 : 1;
        }
    }
    EXPECT_EQ(differ, 0U);
    EXPECT_EQ(model_differs, 130U);
}

} // namespace
} // namespace degs::rtl_test
