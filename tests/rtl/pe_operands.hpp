// SPDX-License-Identifier: Apache-2.0
// Tasks for a PE: as Span Units make them, and as they hurt.
#pragma once

#include "splat/pixels/data_path.hpp"
#include "tests/rtl/pe_bench.hpp"
#include "tests/rtl/span_operands.hpp"

namespace degs::rtl_test {

/// Draws tasks in the formats of a number set.
class PeOperands {
public:
    PeOperands(const QuantizedRow& row, unsigned seed)
        : row_(row), set_(row.set()), draw_(row, seed), spans_(row, seed + 1) {}

    /// A pixel of a span of a frame's splat.
    PeOperand task_of_span() {
        while (left_ == 0) {
            next_span();
        }
        --left_;
        PeOperand operand = of_span_;
        operand.of_span = true;
        operand.n = span_.x0 + left_ - span_.base;
        finish(operand);
        return operand;
    }
    /// Any codes of g0, d0, A and colour.
    PeOperand any_task() {
        PeOperand operand;
        operand.n = draw_.integer(-128, 127);
        operand.g0 = draw_.any(set_.g0, draw_.one_of(8));
        operand.d0 = draw_.any(set_.d0, true);
        operand.splat.a = draw_.any(set_.conic, false);
        if (draw_.one_of(2)) { // terms within the range of q
            operand.g0 = Rounder(set_.g0)(draw_.real(0, 1.2 * set_.q_limit()));
            operand.d0 = draw_.nudged(set_.d0, draw_.real(-4, 4));
            operand.splat.a = draw_.nudged(set_.conic, std::exp(draw_.real(-12, 0)));
            operand.n = draw_.integer(-20, 40);
        }
        for (double& channel : operand.splat.colour) {
            channel = draw_.any(set_.colour, false);
        }
        const double cut = draw_.one_of(3) ? draw_.real(0, 6) : 0;
        operand.splat.q_inside = Rounder(set_.q)(set_.q_limit() - cut);
        finish(operand);
        return operand;
    }
    /// q alone: g0 is any code, and the terms are 0.
    static PeOperand task_of_q(double g0, double q_inside) {
        PeOperand operand;
        operand.g0 = g0;
        operand.splat.q_inside = q_inside;
        operand.fresh = PixelState{};
        return operand;
    }
    /// A state that T(1 - alpha) brings to 1e-4 or near it, or any other.
    PixelState any_state(double alpha) {
        PixelState state;
        const double near = 1e-4 / std::max(1 - alpha, 1e-3) * draw_.real(0.98, 1.02);
        state.transmittance = Rounder(set_.transmittance)(draw_.one_of(2) ? draw_.real(1e-4, 1)
                                                                          : std::min(near, 0.999));
        for (double& sum : state.rgb) {
            sum =
                draw_.one_of(4) ? draw_.any(set_.sum, false) : Rounder(set_.sum)(draw_.real(0, 2));
        }
        state.live = !draw_.one_of(16);
        return state;
    }
    SpanOperands& draw() { return draw_; }

private:
    void next_span() {
        const ProjectedSplat splat = spans_.projected();
        for (int i = 0; i < 8 && left_ == 0; ++i) {
            const SpanOperand row = spans_.row_of(splat);
            span_ = row_.solve(row.splat, row.y, row.x_begin, row.x_begin + row.columns);
            left_ = span_.x1 - span_.x0 + 1;
            of_span_.splat = row.splat;
        }
        for (double& channel : of_span_.splat.colour) {
            channel = Rounder(set_.colour)(draw_.real(0, 1.5));
        }
        of_span_.g0 = span_.g0;
        of_span_.d0 = span_.d0;
    }
    void finish(PeOperand& operand) {
        operand.stop = draw_.one_of(2) ? StopRule::After : StopRule::Refuse;
    }

    const QuantizedRow& row_;
    const NumberSet& set_;
    SpanOperands draw_, spans_;
    QuantizedSpan span_;
    PeOperand of_span_;
    int left_ = 0; ///< pixels of the span
};

} // namespace degs::rtl_test
