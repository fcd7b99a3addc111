// SPDX-License-Identifier: Apache-2.0
// The RTL of a PE against the model, bit by bit.
#include <systemc>
using sc_core::sc_time_stamp; // headers of Verilator want it where SystemC is in use

#include <algorithm>
#include <iostream>
#include <memory>

#include <gtest/gtest.h>

#include "Vpe_0.h"
#include "Vpe_1.h"

#include "tests/rtl/hard_operands.hpp"
#include "tests/rtl/pe_operands.hpp"

namespace degs::rtl_test {
namespace {

constexpr int kRandomTasks = 1'000'000;

void expect_same(const PeCounts& counts) {
    EXPECT_EQ(counts.differing_bits, 0U) << counts.first;
    std::cout << counts.operands << " tasks: " << counts.useful << " useful, " << counts.boundary
              << " boundary, " << counts.terminated << " terminated, " << counts.ended
              << " end the pixel, " << counts.at_most_alpha << " with alpha 0.99; "
              << counts.differing_operands << " differ, in " << counts.differing_bits
              << " bits; the lanes differ from the definition in " << counts.lanes_differ << " of "
              << counts.lanes_compared << "\n";
}

/// Half of the tasks are those of spans of frames, half are adversarial.
template <class Rtl>
PeCounts compare_random_tasks(const QuantizedRow& row) {
    PeOperands operands(row, 1);
    PeBench<Rtl> bench(row);
    SpanOperands& draw = operands.draw();
    int last[2] = {-1, -1};
    for (int i = 0; i < kRandomTasks; ++i) {
        PeOperand operand = i % 2 == 0 ? operands.task_of_span() : operands.any_task();
        do {
            operand.pixel = draw.integer(0, draw.one_of(2) ? 7 : PeBench<Rtl>::kPixels - 1);
        } while (operand.pixel == last[0] || operand.pixel == last[1]);
        last[i % 2] = operand.pixel;
        if (draw.one_of(bench.pixel(operand.pixel).live ? 16 : 2)) {
            const QuantizedSplat& splat = operand.splat;
            operand.fresh = draw.one_of(2)
                                ? PixelState{}
                                : operands.any_state(row.alpha(
                                      splat, row.q(splat.a, operand.g0, operand.d0, operand.n)));
        }
        bench.put(operand);
        if (draw.one_of(16)) {
            bench.pause();
        }
    }
    expect_same(bench.finish());
    return bench.finish();
}

TEST(PeRtl, BlendsRandomTasksInPaperAsTheModelDoes) {
    const QuantizedRow row(number_set("paper"));
    const PeCounts counts = compare_random_tasks<Vpe_0>(row);
    EXPECT_EQ(counts.lanes_differ, 0U);
}

// The lanes round products of more than 24 bits twice (docs/numbers.md): a weight that is a unit
// off makes two units where a colour exceeds 1.
TEST(PeRtl, BlendsRandomTasksInTunedAsTheDefinitionDoes) {
    const QuantizedRow row(number_set("tuned"));
    const PeCounts counts = compare_random_tasks<Vpe_1>(row);
    EXPECT_LT(counts.lanes_differ, counts.lanes_compared / 400);
    EXPECT_LE(counts.lanes_most_units, 2U);
}

/// Every code of q, on a pixel with T = 1.
template <class Rtl>
void compare_all_q(const char* numbers) {
    const QuantizedRow row(number_set(numbers));
    PeBench<Rtl> bench(row);
    const NumberFormat& format = row.set().g0;
    const double inside = Rounder(row.set().q)(row.set().q_limit());
    for (int code = 0; code < 1 << 16; ++code) {
        PeOperand operand = PeOperands::task_of_q(value_of_code(format, code), inside);
        operand.pixel = code % PeBench<Rtl>::kPixels;
        bench.put(operand);
    }
    expect_same(bench.finish());
}

TEST(PeRtl, GivesTheAlphaOfEveryQInPaper) {
    compare_all_q<Vpe_0>("paper");
}

TEST(PeRtl, GivesTheAlphaOfEveryQInTuned) {
    compare_all_q<Vpe_1>("tuned");
}

template <class Rtl>
void compare_hard_tasks(const char* numbers) {
    const QuantizedRow row(number_set(numbers));
    const HardTasks hard(row);
    PeBench<Rtl> bench(row);
    int pixel = 0;
    const auto put = [&](PeOperand operand) {
        operand.pixel = pixel++ % PeBench<Rtl>::kPixels;
        bench.put(operand);
    };
    hard.each_special(put);
    hard.each_stop(put);
    expect_same(bench.finish());
}

TEST(PeRtl, BlendsHardTasksInPaperAsTheModelDoes) {
    compare_hard_tasks<Vpe_0>("paper");
}

TEST(PeRtl, BlendsHardTasksInTunedAsTheModelDoes) {
    compare_hard_tasks<Vpe_1>("tuned");
}

} // namespace
} // namespace degs::rtl_test
