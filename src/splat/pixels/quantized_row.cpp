// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/quantized_row.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "splat/frame/pixel_index.hpp"

namespace degs {
namespace {

int to_int(double pixel) {
    return index_within(pixel, -kFarPixel, kFarPixel);
}

} // namespace

QuantizedRow::QuantizedRow(NumberSet set)
    : set_(std::move(set)), unit_(set_.exponent == Exponent::Natural ? 1.0 : kHalfLog2e),
      q_limit_(set_.q_limit()), mean_(set_.mean), slope_(set_.slope), c_prime_(set_.c_prime),
      radius_(set_.radius), inverse_radius2_(set_.inverse_radius2), conic_(set_.conic),
      q_threshold_(set_.q_threshold), colour_(set_.colour), distance_(set_.distance),
      square_(set_.square), ratio_(set_.ratio), edge_(set_.edge), level_(set_.level), g0_(set_.g0),
      d0_(set_.d0), term_(set_.term), q_(set_.q), alpha_(set_.alpha),
      transmittance_(set_.transmittance), weight_(set_.weight), sum_(set_.sum), sqrt_(set_.sqrt),
      exp_(set_.exp) {
    fold_limit_ = level_(q_limit_);
    alpha_max_ = alpha_(0.99);
    half_unit_ = 0.5 * std::ldexp(1.0, -set_.mean.fraction_bits);
}

QuantizedSplat QuantizedRow::record(const ProjectedSplat& splat) const {
    QuantizedSplat out;
    if (set_.mean_form == Mean::PixelAndOffset) {
        out.pixel_x = std::clamp<double>(std::nearbyint(splat.mu_x), -kFarPixel, kFarPixel);
        out.pixel_y = std::clamp<double>(std::nearbyint(splat.mu_y), -kFarPixel, kFarPixel);
    }
    out.mean_x = mean_(splat.mu_x - out.pixel_x);
    out.mean_y = mean_(splat.mu_y - out.pixel_y);
    out.q_threshold = q_threshold_(unit_ * splat.q_end());
    const double opaque = q_threshold_(unit_ * (splat.q_threshold + splat.q_cut_off));
    out.fold = level_(fold_limit_ - opaque);
    out.limit = level_(q_limit_ - (opaque - out.q_threshold));
    out.q_inside = q_(q_limit_ - (opaque - out.q_threshold));
    for (int channel = 0; channel < 3; ++channel) {
        out.colour[channel] = colour_(splat.colour[channel]);
    }
    if (set_.derivation == Derivation::Literal) {
        derive_literally(splat, out);
    } else {
        derive(splat, out);
    }
    return out;
}

void QuantizedRow::derive(const ProjectedSplat& splat, QuantizedSplat& out) const {
    out.slope = slope_(splat.cov_b / splat.cov_c);
    out.c_prime = c_prime_(unit_ / splat.cov_c);
    out.a = conic_(unit_ * splat.conic_a());
    out.radius = radius_(std::sqrt(splat.q_end() * (splat.det / splat.cov_c)));
    // Finite also if the splat has no more than its mean's pixel (Q_th = 0): 0 * inf is NaN.
    out.inverse_radius2 =
        std::min(inverse_radius2_(1 / (splat.cov_c * splat.q_end())), set_.inverse_radius2.max());
}

void QuantizedRow::derive_literally(const ProjectedSplat& splat, QuantizedSplat& out) const {
    const double b = conic_(unit_ * splat.conic_b());
    const double c = conic_(unit_ * splat.conic_c());
    out.a = conic_(unit_ * splat.conic_a());
    out.slope = slope_(-b / out.a);
    out.c_prime = c_prime_(c - c_prime_(c_prime_(b * b) / out.a));
    out.radius = radius_(std::sqrt(radius_(out.q_threshold / out.a)));
    out.inverse_radius2 = inverse_radius2_(out.c_prime / out.q_threshold);
}

QuantizedRow::Row QuantizedRow::row_at(const QuantizedSplat& splat, int y) const {
    Row row{};
    row.dy = distance_((y - splat.pixel_y) - splat.mean_y);
    row.x = ratio_(set_.vertical == Vertical::Squared
                       ? square_(row.dy * row.dy) * splat.inverse_radius2
                       : square_(row.dy * splat.inverse_radius2) * row.dy);
    return row;
}

double QuantizedRow::centre_of(const QuantizedSplat& splat, const Row& row) const {
    return edge_(splat.mean_x + edge_(splat.slope * row.dy));
}

bool QuantizedRow::meets(const QuantizedSplat& splat, int y) const {
    return row_at(splat, y).x <= 1;
}

QuantizedCheck QuantizedRow::check(const QuantizedSplat& splat, int y) const {
    const Row row = row_at(splat, y);
    QuantizedCheck check;
    check.level = level(splat, row);
    // Adding A u^2 >= 0 cannot round below.
    check.possible =
        (set_.vertical != Vertical::FromRatio || row.x <= 1) && q_(check.level) <= splat.q_inside;
    check.centre = centre_of(splat, row);
    return check;
}

double QuantizedRow::checked_q(const QuantizedSplat& splat, const QuantizedCheck& row,
                               int x) const {
    const double u = distance_((x - splat.pixel_x) - row.centre);
    return q_(level_(square_(square_(splat.a * u) * u) + row.level));
}

// In one piece: the roundings are worth more inline than anything else in here.
[[gnu::flatten]] QuantizedSpan QuantizedRow::solve(const QuantizedSplat& splat, int y, int x_begin,
                                                   int x_end) const {
    const Row row = row_at(splat, y);
    if (!(row.x <= 1)) {
        return {};
    }
    const double centre = centre_of(splat, row);
    const Ends whole = ends(splat, row, centre);
    const double left = std::max(whole.left, x_begin - splat.pixel_x);
    const double right = std::min(whole.right, x_end - 1 - splat.pixel_x);
    return left <= right ? span_vector(splat, row, centre, left, right) : QuantizedSpan{};
}

QuantizedSpan QuantizedRow::span_vector(const QuantizedSplat& splat, const Row& row, double centre,
                                        double left, double right) const {
    const double base =
        set_.base == Base::Start ? left : std::clamp(std::nearbyint(centre), left, right);
    const double u = distance_(base - centre);
    const double rise = square_(square_(splat.a * u) * u);
    QuantizedSpan span;
    span.g0 = g0_(level_(rise + level(splat, row)));
    span.d0 = d0_(splat.a * square_(2 * u + 1));
    const int origin = to_int(splat.pixel_x);
    span.x0 = to_int(left) + origin;
    span.x1 = to_int(right) + origin;
    span.base = to_int(base) + origin;
    return span;
}

/// The ends of the span in the whole row, whatever the columns of the tile.
QuantizedRow::Ends QuantizedRow::ends(const QuantizedSplat& splat, const Row& row,
                                      double centre) const {
    const double root = sqrt_(row.x);
    const double width = edge_(splat.radius * root);
    const double left = edge_(centre - width);
    const double right = edge_(centre + width);
    if (set_.ends == SpanEnds::Exact) {
        return {std::ceil(left - set_.guard), std::floor(right + set_.guard)};
    }
    double delta = set_.delta;
    if (set_.ends == SpanEnds::Slope) {
        // |dw/dy| = r_x |dy| inv_ry^2 / sqrt(1 - x), for an error of half a unit of dy; at the
        // tips, where it grows without bounds, the span is no longer than a pixel or two.
        const double steep = splat.radius * std::abs(row.dy) * splat.inverse_radius2;
        delta += root > 0 ? std::min(1.0, std::nearbyint(steep / root * half_unit_)) : 1.0;
    }
    return {std::floor(left) - delta, std::ceil(right) + delta};
}

/// C' dy^2 - 2 ln o: what a row's q' is at the vertex.
double QuantizedRow::level(const QuantizedSplat& splat, const Row& row) const {
    if (set_.vertical == Vertical::FromRatio) {
        return level_(splat.limit - level_(splat.q_threshold * ratio_(1 - row.x)));
    }
    const double vertical = set_.vertical == Vertical::Squared
                                ? level_(square_(row.dy * row.dy) * splat.c_prime)
                                : level_(square_(row.dy * splat.c_prime) * row.dy);
    return level_(vertical + splat.fold);
}

double QuantizedRow::times(double value, int integer) const {
    if (set_.multiplier == IntegerMultiplier::Whole) {
        return term_(value * integer);
    }
    const int low = integer % (1 << set_.lookup_bits); // of the magnitude, with the sign
    return term_(term_(value * low) + term_(value * (integer - low)));
}

double QuantizedRow::q(double a, double g0, double d0, int n) const {
    const double linear = times(d0, n);
    const double quadratic = times(a, n * (n - 1));
    if (set_.base == Base::Start) {
        return q_(q_(g0 + linear) + quadratic);
    }
    return q_(g0 + term_(linear + quadratic));
}

double QuantizedRow::alpha(const QuantizedSplat& splat, double q) const {
    if (set_.q_mask && q > splat.q_inside) {
        return 0;
    }
    return std::min(alpha_max_, alpha_(exp_(q)));
}

void QuantizedRow::blend(double alpha, const double (&colour)[3], QuantizedPixel& pixel) const {
    const double weight = weight_(alpha * pixel.transmittance);
    for (int channel = 0; channel < 3; ++channel) {
        pixel.rgb[channel] = sum_(pixel.rgb[channel] + weight_(weight * colour[channel]));
    }
    pixel.transmittance = transmittance_(pixel.transmittance * transmittance_(1 - alpha));
}

} // namespace degs
