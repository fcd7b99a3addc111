// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/quantized_extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace degs {
namespace {

int to_pixel(double x) {
    const double below = x < kFarPixel ? x : kFarPixel; // also NaN
    return static_cast<int>(below > -kFarPixel ? below : -kFarPixel);
}

/// Error of the double arithmetic below, px.
double slack_of(double magnitude) {
    return 1e-6 + 1e-9 * magnitude;
}

} // namespace

QuantizedSlack::RoundingError::RoundingError(const NumberFormat& format)
    : most_(format.max()), least_(format.quantum() / 2),
      share_(format.kind == NumberFormat::Kind::Fixed
                 ? 0.0
                 : std::ldexp(1.0, -format.fraction_bits - 1)) {}

double QuantizedSlack::RoundingError::of(double magnitude) const {
    return magnitude <= most_ ? std::max(share_ * magnitude, least_)
                              : std::numeric_limits<double>::infinity();
}

QuantizedSlack::QuantizedSlack(const NumberSet& set)
    : distance_(set.distance), square_(set.square), ratio_(set.ratio), edge_(set.edge),
      squared_(set.vertical == Vertical::Squared) {
    const TableSpec& table = set.sqrt;
    const double unit = RoundingError(table.values).of(1);
    switch (table.interpolation) {
    case Interpolation::Exact:
        root_ = unit;
        break;
    case Interpolation::Nearest: // the root of another x of the cell
        cell_ = (table.reduction == Reduction::None ? table.range : 1.0) / table.entries;
        root_ = unit;
        break;
    case Interpolation::Linear: // value, fall, product and difference are rounded
        root_ = LookupTable(table).shape_error() + 4 * unit;
        break;
    }
    if (table.interpolation != Interpolation::Exact && table.reduction == Reduction::None) {
        cell_ += std::max(0.0, 1 - table.range); // beyond it the last cell counts
    }
    outward_ = set.ends == SpanEnds::Exact ? set.guard
                                           : 1 + set.delta + (set.ends == SpanEnds::Slope ? 1 : 0);
}

double QuantizedSlack::ratio(const QuantizedSplat& splat, double reach) const {
    const double of_dy = distance_.of(reach);
    const double dy = reach + of_dy;
    const double inverse = splat.inverse_radius2;
    const double from_dy = inverse * of_dy * (2 * reach + of_dy);
    const double product = squared_ ? inverse * square_.of(dy * dy) : dy * square_.of(dy * inverse);
    return from_dy + product + ratio_.of(1.5) + cell_;
}

double QuantizedSlack::ends(const QuantizedSplat& splat, double reach) const {
    const double of_dy = distance_.of(reach);
    const double slope = std::abs(splat.slope);
    const double shift = slope * (reach + of_dy);
    const double centre = 1.01 * (std::abs(splat.mean_x) + shift) + 1;
    const double width = 1.01 * splat.radius + 1;
    return slope * of_dy + edge_.of(shift) + edge_.of(centre) + splat.radius * root_ +
           edge_.of(width) + edge_.of(centre + width) + outward_;
}

QuantizedExtent::QuantizedExtent(const QuantizedRow& row, const QuantizedSlack& slack,
                                 const QuantizedSplat& splat)
    : x_(splat.pixel_x + splat.mean_x), y_(splat.pixel_y + splat.mean_y), slope_(splat.slope) {
    rows_ = rows_of(row, splat, y_);
    if (rows_.empty()) {
        return;
    }
    const double reach = std::max(std::abs(rows_.first - y_), std::abs(rows_.last - y_));
    // sqrt(1 + e - x) is the half-width of an ellipse that is 1 + e times as large, squared.
    const double growth = 1 + slack.ratio(splat, reach);
    radius_ = splat.radius * std::sqrt(growth);
    inverse_ = splat.inverse_radius2 / growth;
    steepness_ = slope_ * slope_ + radius_ * radius_ * inverse_;
    margin_ = slack.ends(splat, reach);
    bounded_ = steepness_ > 0 && std::isfinite(steepness_ + radius_ + margin_ + x_ + reach);
    columns_ = {-kFarPixel, kFarPixel};
    if (bounded_) {
        const double width =
            std::min(std::sqrt(steepness_ / inverse_), std::abs(slope_) * reach + radius_) +
            margin_;
        const double rounding = slack_of(std::abs(x_) + width);
        columns_ = {to_pixel(std::ceil(x_ - width - rounding)),
                    to_pixel(std::floor(x_ + width + rounding))};
    }
}

// Rows are accepted up to a distance from the mean and refused beyond it, rounded or not.
PixelRange QuantizedExtent::rows_of(const QuantizedRow& row, const QuantizedSplat& splat,
                                    double centre) {
    const int nearest = to_pixel(std::nearbyint(centre));
    if (!row.meets(splat, nearest)) {
        return {};
    }
    const double reach = 1 / std::sqrt(splat.inverse_radius2);
    const auto last_in = [&](int direction) {
        const int guess = to_pixel(centre + direction * (reach < kFarPixel ? reach : kFarPixel));
        const auto meets = [&](int distance) {
            return row.meets(splat, nearest + direction * distance);
        };
        const int guessed = std::abs(guess - nearest);
        int in = guessed > 2 && meets(guessed - 2) ? guessed - 2 : 0;
        int out = meets(guessed + 2) ? kFarPixel : guessed + 2;
        while (out - in > 1) {
            const int middle = in + (out - in) / 2;
            (meets(middle) ? in : out) = middle;
        }
        return nearest + direction * in;
    };
    return {last_in(-1), last_in(+1)};
}

PixelRange QuantizedExtent::rows_in_columns(int x_begin, int x_end) const {
    if (!bounded_) {
        return rows_;
    }
    PixelRange rows = rows_;
    const double rounding = slack_of(std::abs(x_) + std::abs(static_cast<double>(x_begin)));
    const double left = x_begin - x_ - margin_ - rounding;
    const double right = x_end - 1 - x_ + margin_ + rounding;
    // Between two columns the ellipse is convex: its lowest row is that of its own lowest point if
    // that lies there, else where the nearer column cuts it; likewise the highest.
    const double tip = slope_ / std::sqrt(inverse_);
    if (-tip < left || -tip > right) {
        rows.first = std::max(rows.first, cut(-tip < left ? left : right, -1));
    }
    if (tip < left || tip > right) {
        rows.last = std::min(rows.last, cut(tip < left ? left : right, +1));
    }
    return rows;
}

/// Row at which column dx (from the mean) leaves the ellipse, upwards (-1) or downwards (+1);
/// beyond every row if the column misses it.
int QuantizedExtent::cut(double dx, int direction) const {
    const double room = steepness_ * (1 + 1e-9) - inverse_ * dx * dx;
    if (!(room >= 0)) {
        return -direction * kFarPixel;
    }
    const double y = (slope_ * dx + direction * radius_ * std::sqrt(room)) / steepness_;
    const double at = y_ + y + direction * slack_of(std::abs(y) + std::abs(y_));
    return to_pixel(direction < 0 ? std::ceil(at) : std::floor(at));
}

} // namespace degs
