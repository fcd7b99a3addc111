// SPDX-License-Identifier: Apache-2.0
// The cases that random operands hardly meet: zeros, subnormals, saturation, edges and ties.
#pragma once

#include <vector>

#include "tests/rtl/pe_bench.hpp"
#include "tests/rtl/span_operands.hpp"

namespace degs::rtl_test {

/// Zero, the smallest values, those about the smallest normal one, 1, and the largest.
inline std::vector<double> special_values(const NumberFormat& format, bool negative) {
    std::vector<double> values = {0, format.quantum(), 3 * format.quantum(), format.max()};
    if (format.kind == NumberFormat::Kind::Float) {
        values.insert(values.end(), {format.min_normal() - format.quantum(), format.min_normal(),
                                     std::numeric_limits<double>::infinity()});
    }
    for (const double usual : {0.3, 1.0, 5.0}) {
        values.push_back(Rounder(format)(usual));
    }
    const std::size_t count = values.size();
    for (std::size_t i = 1; negative && i < count; ++i) {
        values.push_back(-values[i]);
    }
    return values;
}

/// Rows of splats of which any two fields are special.
class HardRows {
public:
    explicit HardRows(const QuantizedRow& row) : set_(row.set()), operands_(row, 7) {}

    template <class Use>
    void each_pair_of_fields(const Use& use) {
        constexpr int kFields = 8;
        for (int a = 0; a < kFields; ++a) {
            for (int b = a + 1; b < kFields; ++b) {
                for (const double of_a : values(a)) {
                    for (const double of_b : values(b)) {
                        SpanOperand operand = usual();
                        field(operand, a) = of_a;
                        field(operand, b) = of_b;
                        finish(operand, use);
                    }
                }
            }
        }
    }
    /// Rows with x = 1 and next to it: dy is a power of two.
    template <class Use>
    void each_edge(const Use& use) {
        for (int k = -3; k <= 10; ++k) {
            const double dy = std::ldexp(1.0, k);
            const std::uint64_t exact =
                code_of(set_.inverse_radius2, Rounder(set_.inverse_radius2)(1 / (dy * dy)));
            for (std::uint64_t code = exact - 3; code <= exact + 3; ++code) {
                SpanOperand operand = usual();
                operand.splat.inverse_radius2 = value_of_code(set_.inverse_radius2, code);
                operand.splat.mean_y = operand.y - dy;
                place(operand, use);
                operand.splat.mean_y = operand.y + dy;
                place(operand, use);
            }
        }
    }
    /// Every place of a tile of 1 and of 16 columns about the span.
    template <class Use>
    void each_place(const Use& use) {
        for (const int columns : {1, 16}) {
            for (int x = 60; x < 140; ++x) {
                SpanOperand operand = usual();
                operands_.finish(operand);
                operand.columns = columns;
                operand.x_begin = x;
                use(operand);
            }
        }
    }
    /// Radii at which |dw/dy| is 256, where delta changes, and next to it.
    template <class Use>
    void each_steepness(const Use& use) {
        for (int k = 0; k < 8; ++k) {
            for (const double x : {0.25, 0.5, 0.75}) {
                SpanOperand operand = usual();
                const double dy = std::ldexp(1.0, k);
                operand.splat.mean_y = operand.y - dy;
                operand.splat.inverse_radius2 = x / (dy * dy);
                const double root = LookupTable(set_.sqrt)(x);
                const double radius = 256 * root / (dy * operand.splat.inverse_radius2);
                const std::uint64_t exact = code_of(set_.radius, Rounder(set_.radius)(radius));
                for (std::uint64_t code = exact - 3; code <= exact + 3; ++code) {
                    operand.splat.radius = value_of_code(set_.radius, code);
                    place(operand, use);
                }
            }
        }
    }

private:
    SpanOperand usual() const {
        SpanOperand operand;
        QuantizedSplat& splat = operand.splat;
        splat.mean_x = 100.25;
        splat.mean_y = 49.5;
        splat.slope = 0.5;
        splat.radius = 5;
        splat.inverse_radius2 = Rounder(set_.inverse_radius2)(0.04);
        splat.a = Rounder(set_.conic)(0.2);
        splat.c_prime = Rounder(set_.c_prime)(0.04);
        splat.q_threshold = operand.uncut = Rounder(set_.q_threshold)(5);
        operand.y = 50;
        return operand;
    }
    std::vector<double> values(int field) const {
        const NumberFormat* const formats[] = {
            &set_.mean,  &set_.mean,    &set_.slope,      &set_.radius, &set_.inverse_radius2,
            &set_.conic, &set_.c_prime, &set_.q_threshold};
        if (field == 6 && set_.vertical == Vertical::FromRatio) {
            return {0};
        }
        std::vector<double> all = special_values(*formats[field], field < 3);
        if (field == 4) { // a record never has an infinite 1 / r_y^2
            for (double& value : all) {
                value = std::min(value, set_.inverse_radius2.max());
            }
        }
        return all;
    }
    static double& field(SpanOperand& operand, int index) {
        QuantizedSplat& s = operand.splat;
        double* const fields[] = {&s.mean_x,          &s.mean_y, &s.slope,   &s.radius,
                                  &s.inverse_radius2, &s.a,      &s.c_prime, &s.q_threshold};
        return *fields[index];
    }
    template <class Use>
    void finish(SpanOperand& operand, const Use& use) {
        operand.uncut = operand.splat.q_threshold;
        const int most = (1 << (set_.mean.integer_bits - 1)) - 300;
        const double at = std::clamp<double>(std::round(operand.splat.mean_y), -most, most);
        const int centre = static_cast<int>(at);
        for (const int y : {50, centre, centre + 1, centre - 2, centre + 5, -most, most}) {
            operand.y = y;
            place(operand, use);
        }
    }
    template <class Use>
    void place(SpanOperand& operand, const Use& use) {
        operands_.finish(operand);
        use(operand);
    }

    const NumberSet& set_;
    SpanOperands operands_;
};

/// Tasks with special g0, d0, A and n, on a new pixel, or with T at the stop threshold.
class HardTasks {
public:
    explicit HardTasks(const QuantizedRow& row) : row_(row), set_(row.set()) {}

    template <class Use>
    void each_special(const Use& use) const {
        PeOperand operand = usual();
        const std::vector<double> colours = special_values(set_.colour, false);
        std::size_t colour = 0;
        for (const double g0 : special_values(set_.g0, set_.g0.has_sign)) {
            for (const double d0 : special_values(set_.d0, true)) {
                for (const double a : special_values(set_.conic, false)) {
                    for (const int n : {-128, -17, -16, -15, -1, 0, 1, 2, 15, 16, 17, 127}) {
                        operand.g0 = g0;
                        operand.d0 = d0;
                        operand.splat.a = a;
                        operand.n = n;
                        operand.splat.colour[colour % 3] = colours[colour / 3 % colours.size()];
                        ++colour;
                        use(operand);
                    }
                }
            }
        }
    }
    /// T (1 - alpha) about 1e-4, for alphas from 0 to 0.99 and both stop rules.
    template <class Use>
    void each_stop(const Use& use) const {
        for (int code = 0; code < 1 << 16; code += 32) {
            PeOperand operand = usual();
            operand.g0 = value_of_code(set_.g0, code);
            const double alpha = row_.alpha(operand.splat, operand.g0);
            const double rest = Rounder(set_.transmittance)(1 - alpha);
            const std::uint64_t near =
                code_of(set_.transmittance, Rounder(set_.transmittance)(1e-4 / rest));
            for (std::uint64_t t = near - 6; t <= near + 6; ++t) {
                for (const StopRule stop : {StopRule::Refuse, StopRule::After}) {
                    operand.stop = stop;
                    operand.fresh->transmittance = value_of_code(set_.transmittance, t);
                    use(operand);
                }
            }
        }
    }

private:
    PeOperand usual() const {
        PeOperand operand;
        operand.fresh = PixelState{};
        operand.splat.q_inside = Rounder(set_.q)(set_.q_limit());
        for (double& channel : operand.splat.colour) {
            channel = Rounder(set_.colour)(0.7);
        }
        return operand;
    }

    const QuantizedRow& row_;
    const NumberSet& set_;
};

} // namespace degs::rtl_test
