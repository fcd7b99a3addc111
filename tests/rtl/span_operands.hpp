// SPDX-License-Identifier: Apache-2.0
// Rows of splats for a Span Unit: as projection makes them, and as they hurt.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/rtl/span_bench.hpp"

namespace degs::rtl_test {

/// Draws rows of splats whose records are in the formats of a number set.
class SpanOperands {
public:
    SpanOperands(const QuantizedRow& row, unsigned seed)
        : row_(row), set_(row.set()), random_(seed) {}

    double real(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    int integer(int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random_);
    }
    bool one_of(int count) { return integer(1, count) == 1; }

    /// A splat as a frame has them, up to 8K: log-uniform axes, any angle and opacity, some cut.
    ProjectedSplat projected() {
        ProjectedSplat splat;
        const double major = std::exp(real(std::log(0.05), std::log(400.0)));
        const double minor = major * std::exp(real(std::log(0.001), 0));
        const double angle = real(0, M_PI);
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        splat.cov_a = major * major * c * c + minor * minor * s * s + 0.3;
        splat.cov_c = major * major * s * s + minor * minor * c * c + 0.3;
        splat.cov_b = (major * major - minor * minor) * c * s;
        splat.det = splat.cov_a * splat.cov_c - splat.cov_b * splat.cov_b;
        splat.opacity = one_of(8) ? real(1.0, 1.05) / 255 : real(1.0 / 255, 1);
        const double whole = 2 * std::log(255 * splat.opacity);
        splat.q_threshold = one_of(6) ? std::min(whole, real(0, 11)) : whole;
        splat.q_cut_off = whole - splat.q_threshold;
        splat.mu_x = real(-200, 8000);
        splat.mu_y = real(-200, 4500);
        return splat;
    }
    /// A row of it, mostly one that meets the ellipse, in a tile near its centre.
    SpanOperand row_of(const ProjectedSplat& splat) {
        SpanOperand operand;
        operand.splat = row_.record(splat);
        operand.uncut =
            Rounder(set_.q_threshold)(row_.unit() * (splat.q_threshold + splat.q_cut_off));
        const double reach = std::sqrt(splat.q_end() * splat.cov_c) + 1;
        const double dy = real(-reach, reach);
        place(operand, std::lround(splat.mu_y + dy), splat.mu_x + splat.cov_b / splat.cov_c * dy,
              std::sqrt(splat.q_end() * splat.cov_a));
        return operand;
    }
    /// A record of any codes; fields that are never negative in a record are not.
    SpanOperand any_record() {
        SpanOperand operand;
        QuantizedSplat& splat = operand.splat;
        splat.mean_x = any(set_.mean, true);
        splat.mean_y = any(set_.mean, true);
        splat.slope = any(set_.slope, true);
        splat.radius = any(set_.radius, false);
        splat.inverse_radius2 =
            std::min(any(set_.inverse_radius2, false), set_.inverse_radius2.max());
        splat.a = any(set_.conic, false);
        splat.c_prime = set_.vertical == Vertical::FromRatio ? 0 : any(set_.c_prime, false);
        splat.q_threshold = threshold();
        operand.uncut = one_of(3) ? threshold() : splat.q_threshold;
        const int most = (1 << (set_.mean.integer_bits - 1)) - 1;
        operand.y = one_of(4) ? integer(-most, most)
                              : static_cast<int>(std::lround(splat.mean_y)) + integer(-40, 40);
        operand.y = std::clamp(operand.y, -most, most);
        finish(operand);
        return operand;
    }
    /// Any record with x = dy^2 / r_y^2 near 1, where rows end, and a half-width of some pixels.
    SpanOperand edge_of_ellipse() {
        SpanOperand operand = any_record();
        QuantizedSplat& splat = operand.splat;
        const double dy = Rounder(set_.distance)(operand.y - splat.mean_y);
        if (dy != 0) {
            const double away = one_of(2) ? real(0.99, 1.01) : real(0, 1.3);
            splat.inverse_radius2 = nudged(set_.inverse_radius2, away / (dy * dy));
        }
        splat.radius = nudged(set_.radius, std::exp(real(-4, 8)));
        splat.slope = nudged(set_.slope, one_of(2) ? real(-1e4, 1e4) : real(-3, 3));
        splat.a = nudged(set_.conic, std::exp(real(-16, 1.2)));
        if (set_.vertical != Vertical::FromRatio) {
            splat.c_prime = nudged(set_.c_prime, std::exp(real(-16, 1.2)));
        }
        finish(operand);
        return operand;
    }

    /// Fold and limit as QuantizedRow::record makes them, and columns near the centre of the row.
    void finish(SpanOperand& operand) {
        QuantizedSplat& splat = operand.splat;
        const Rounder level(set_.level);
        const double limit = set_.q_limit();
        splat.fold = level(level(limit) - operand.uncut);
        splat.limit = level(limit - (operand.uncut - splat.q_threshold));
        const double centre = splat.mean_x + splat.slope * (operand.y - splat.mean_y);
        const double width = std::isfinite(splat.radius) ? splat.radius : 0;
        place(operand, operand.y, std::isfinite(centre) ? centre : splat.mean_x, width);
    }

    /// The value of a random code, sometimes with extreme bits; NaN is never in a record.
    double any(const NumberFormat& format, bool negative) {
        const int bits = format.storage_bits() - (format.has_sign && !negative ? 1 : 0);
        std::uint64_t code = random_() & low_bits(bits);
        switch (integer(0, 15)) {
        case 0:
            code &= low_bits(bits / 3); // small, of floats the subnormals
            break;
        case 1:
            code |= low_bits(bits / 2) << (bits - bits / 2);
            break;
        case 2:
            code = integer(0, 3);
            break;
        default:
            break;
        }
        const double value = value_of_code(format, code);
        return std::isnan(value) || std::abs(value) > format.max() ? largest(format) : value;
    }
    /// The value in the format, or a neighbour.
    double nudged(const NumberFormat& format, double value) {
        const std::uint64_t code = code_of(format, Rounder(format)(value));
        const double near = value_of_code(format, code + integer(-1, 1));
        return code == 0 || std::isnan(near) ? value_of_code(format, code) : near;
    }

private:
    /// The columns of a tile that the row of this centre and half-width mostly meets.
    void place(SpanOperand& operand, long y, double centre, double width) {
        static constexpr int kColumns[] = {1, 2, 8, 16, 16, 32, 32, 64, 128};
        const int most = (1 << (set_.mean.integer_bits - 1)) - 300;
        operand.y = static_cast<int>(y);
        operand.columns = kColumns[integer(0, 8)];
        const double at = centre + real(-1.1, 1.1) * width + integer(-operand.columns, 4);
        operand.x_begin = static_cast<int>(std::lround(std::clamp<double>(at, -most, most)));
    }
    double threshold() {
        return Rounder(set_.q_threshold)(one_of(8) ? 0 : real(0, set_.q_limit()));
    }
    double largest(const NumberFormat& format) {
        return format.kind == NumberFormat::Kind::Float && one_of(2)
                   ? std::numeric_limits<double>::infinity()
                   : format.max();
    }
    const QuantizedRow& row_;
    const NumberSet& set_;
    std::mt19937 random_;
};

} // namespace degs::rtl_test
