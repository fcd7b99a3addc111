// SPDX-License-Identifier: Apache-2.0
// Drives the RTL of a Span Unit with rows of splats and compares what it gives, bit by bit, with
// what the model gives.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <sstream>
#include <string>

#include "splat/pixels/quantized_row.hpp"
#include "tests/rtl/number_code.hpp"
#include "tests/rtl/rtl_folder.hpp"

namespace degs::rtl_test {

/// A row of a splat inside a tile. `uncut` is Q_th before a cut.
struct SpanOperand {
    QuantizedSplat splat;
    double uncut = 0;
    int y = 0, x_begin = 0, columns = 16;
};

/// What a Span Unit gives, in bits.
struct SpanResult {
    bool found = false;
    std::uint64_t x0 = 0, length = 0, base = 0, g0 = 0, d0 = 0;

    /// How many bits differ; without a span only `found` counts.
    int differences(const SpanResult& other) const {
        if (!found || !other.found) {
            return found == other.found ? 0 : 1;
        }
        int bits = 0;
        for (const std::uint64_t each : {x0 ^ other.x0, length ^ other.length, base ^ other.base,
                                         g0 ^ other.g0, d0 ^ other.d0}) {
            bits += __builtin_popcountll(each);
        }
        return bits;
    }
};
inline std::ostream& operator<<(std::ostream& out, const SpanResult& result) {
    return out << "found " << result.found << ", x0 " << result.x0 << ", length " << result.length
               << ", base " << result.base << std::hex << ", g0 " << result.g0 << ", d0 "
               << result.d0 << std::dec;
}

/// What was compared.
struct SpanCounts {
    std::uint64_t operands = 0, spans = 0, differing_operands = 0, differing_bits = 0;
    std::string first; ///< difference
};

template <class Rtl>
class SpanBench {
public:
    explicit SpanBench(const QuantizedRow& row) : row_(row) {
        const InTableFolder folder;
        rtl_.eval();
    }

    /// The row in the next cycle; the result that is due is compared.
    void put(const SpanOperand& operand) {
        drive(operand);
        step(true);
        Waiting& place = waiting_[cycle_ % kStages];
        place = {true, operand, expected(operand)};
    }
    /// A cycle without a row; its inputs are those of the row before.
    void pause() {
        step(false);
        waiting_[cycle_ % kStages].taken = false;
    }
    const SpanCounts& finish() {
        for (std::size_t i = 0; i < kStages; ++i) {
            pause();
        }
        return counts_;
    }

private:
    static constexpr std::size_t kStages = 15;
    struct Waiting {
        bool taken = false;
        SpanOperand operand;
        SpanResult expected;
    };

    SpanResult expected(const SpanOperand& operand) const {
        const int end = operand.x_begin + operand.columns;
        const QuantizedSpan span = row_.solve(operand.splat, operand.y, operand.x_begin, end);
        SpanResult result;
        result.found = !span.empty();
        result.x0 = span.x0 - operand.x_begin;
        result.length = span.x1 - span.x0 + 1;
        result.base = span.base - operand.x_begin;
        result.g0 = code_of(row_.set().g0, span.g0);
        result.d0 = code_of(row_.set().d0, span.d0);
        return result;
    }

    void drive(const SpanOperand& operand) {
        const NumberSet& set = row_.set();
        const NumberFormat& mean = set.mean;
        const auto mask = low_bits(mean.integer_bits);
        rtl_test::put(rtl_.y, operand.y & mask);
        rtl_test::put(rtl_.x_begin, operand.x_begin & mask);
        rtl_test::put(rtl_.columns, operand.columns);
        rtl_test::put(rtl_.mean_x, code_of(mean, operand.splat.mean_x));
        rtl_test::put(rtl_.mean_y, code_of(mean, operand.splat.mean_y));
        rtl_test::put(rtl_.slope, code_of(set.slope, operand.splat.slope));
        rtl_test::put(rtl_.radius, code_of(set.radius, operand.splat.radius));
        rtl_test::put(rtl_.inverse, code_of(set.inverse_radius2, operand.splat.inverse_radius2));
        rtl_test::put(rtl_.conic, code_of(set.conic, operand.splat.a));
        rtl_test::put(rtl_.c_prime, set.vertical == Vertical::FromRatio
                                        ? 0
                                        : code_of(set.c_prime, operand.splat.c_prime));
        rtl_test::put(rtl_.q_threshold, code_of(set.q_threshold, operand.splat.q_threshold));
        rtl_test::put(rtl_.q_uncut, code_of(set.q_threshold, operand.uncut));
    }

    /// The edge that takes the inputs is also the one after which the oldest result is due.
    void step(bool valid) {
        rtl_.valid = valid ? 1 : 0;
        rtl_.clk = 0;
        rtl_.eval();
        ++cycle_;
        // The operand of kStages - 1 cycles ago comes out with this edge.
        rtl_.clk = 1;
        rtl_.eval();
        const Waiting& due = waiting_[(cycle_ + 1) % kStages];
        if (cycle_ < kStages) {
            return;
        }
        SpanResult result{rtl_.found != 0, rtl_.x0, rtl_.length, rtl_.base, rtl_.g0, rtl_.d0};
        compare(due, result);
    }
    void compare(const Waiting& due, const SpanResult& result) {
        const SpanResult wanted = due.taken ? due.expected : SpanResult{};
        const int bits = result.differences(wanted);
        counts_.operands += due.taken ? 1 : 0;
        counts_.spans += wanted.found ? 1 : 0;
        counts_.differing_operands += bits != 0 ? 1 : 0;
        counts_.differing_bits += bits;
        if (bits != 0 && counts_.first.empty()) {
            std::ostringstream out;
            out.precision(17);
            const QuantizedSplat& s = due.operand.splat;
            out << "row " << due.operand.y << " of columns " << due.operand.x_begin << " + "
                << due.operand.columns << ", mean " << s.mean_x << " " << s.mean_y << ", m "
                << s.slope << ", r_x " << s.radius << ", 1/r_y^2 " << s.inverse_radius2 << ", A "
                << s.a << ", C' " << s.c_prime << ", Q_th " << s.q_threshold << " of "
                << due.operand.uncut << "\nmodel: " << wanted << "\nRTL:   " << result;
            counts_.first = out.str();
        }
    }

    const QuantizedRow& row_;
    Rtl rtl_;
    std::size_t cycle_ = 0;
    std::array<Waiting, kStages> waiting_;
    SpanCounts counts_;
};

} // namespace degs::rtl_test
