// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/frame/projection.hpp"
#include "splat/numbers/number_set.hpp"

namespace degs {

/// A row or column beyond every image. Floats are limited to it before they are converted to int,
/// and sums with it do not overflow.
constexpr int kFarPixel = 1 << 29;

/// The record of a splat in the formats of a number set; double only carries the values.
struct QuantizedSplat {
    double pixel_x = 0, pixel_y = 0; ///< Mean::PixelAndOffset: nearest pixel, else 0
    double mean_x = 0, mean_y = 0;   ///< px, from pixel_x and pixel_y
    double slope = 0;                ///< m
    double c_prime = 0;              ///< C'
    double radius = 0;               ///< r_x, px
    double inverse_radius2 = 0;      ///< 1 / r_y^2, px^-2
    double a = 0;                    ///< A
    double q_threshold = 0;          ///< Q_th
    double fold = 0;                 ///< -2 ln o, from Q_th before the cut
    double limit = 0;                ///< q' at q = Q_th: that of alpha = 1/255, or of the cut
    double q_inside = 0;             ///< `limit` in the format of q: the largest q' inside
    double colour[3] = {0, 0, 0};
};

/// One row of a splat: the Span Vector.
struct QuantizedSpan {
    int x0 = 0, x1 = -1; ///< first and last pixel
    int base = 0;        ///< the pixel of n = 0
    double g0 = 0, d0 = 0;
    bool empty() const { return x1 < x0; }
};

/// The part of a row that all pixels share when each checks for itself: q' = A u^2 + level.
struct QuantizedCheck {
    bool possible = false; ///< no pixel of the row passes if not
    double centre = 0;     ///< x_c, px from the splat's own pixel
    double level = 0;      ///< C' dy^2 - 2 ln o
};

/// A pixel's state.
struct QuantizedPixel {
    double transmittance = 1;
    double rgb[3] = {0, 0, 0};
};

/// The row path of DeGS in the formats of a number set, value by value: record, Span Unit, PE.
/// Every operation is carried out in double and rounded once to the format of its result. This is
/// the definition; row_lanes.hpp and quantized_lanes.hpp compute rows and pixels faster.
class QuantizedRow {
public:
    explicit QuantizedRow(NumberSet set);

    const NumberSet& set() const { return set_; }
    QuantizedSplat record(const ProjectedSplat& splat) const;
    /// Solves image row `y` for the columns x_begin .. x_end - 1 (paper Eq. 12-15, 19).
    QuantizedSpan solve(const QuantizedSplat& splat, int y, int x_begin, int x_end) const;
    /// True if row `y` meets the ellipse (x <= 1). All rows nearer to the mean then meet it as
    /// well.
    bool meets(const QuantizedSplat& splat, int y) const;
    /// The coupled check of a pixel (DataPath::test) with the Span Unit's operations: dy, x_c and
    /// level as in solve(), then q' = (A u) u + level, rounded to the format of q. With
    /// Vertical::FromRatio the level is Q_limit - Q_th (1 - x); 1 - x has no sign there, so a row
    /// with x > 1 fails as a whole.
    QuantizedCheck check(const QuantizedSplat& splat, int y) const;
    /// q' of a pixel. Rounding keeps order, so q' never falls with the distance from x_c.
    double checked_q(const QuantizedSplat& splat, const QuantizedCheck& row, int x) const;
    /// Units of q in a nat: 1, or log2(e) / 2.
    double unit() const { return unit_; }
    /// q_n of a pixel (Eq. 18); `a` is the record's.
    double q(double a, double g0, double d0, int n) const;
    /// Eq. 21 with the reference's limit of 0.99; 0 where a q mask drops the pixel, as it does
    /// beyond the splat's `q_inside`.
    double alpha(const QuantizedSplat& splat, double q) const;
    /// Eq. 8.
    void blend(double alpha, const double (&colour)[3], QuantizedPixel& pixel) const;

private:
    struct Row {
        double dy, x;
    };
    /// First and last pixel of a span, from the splat's own pixel; without any, left > right.
    struct Ends {
        double left, right;
    };
    Row row_at(const QuantizedSplat& splat, int y) const;
    double centre_of(const QuantizedSplat& splat, const Row& row) const;
    void derive(const ProjectedSplat& splat, QuantizedSplat& out) const;
    void derive_literally(const ProjectedSplat& splat, QuantizedSplat& out) const;
    Ends ends(const QuantizedSplat& splat, const Row& row, double centre) const;
    QuantizedSpan span_vector(const QuantizedSplat& splat, const Row& row, double centre,
                              double left, double right) const;
    double level(const QuantizedSplat& splat, const Row& row) const;
    double times(double value, int integer) const;

    NumberSet set_;
    double unit_, q_limit_, fold_limit_, alpha_max_;
    double half_unit_; // of the mean, px
    Rounder mean_, slope_, c_prime_, radius_, inverse_radius2_, conic_, q_threshold_, colour_;
    Rounder distance_, square_, ratio_, edge_, level_, g0_, d0_;
    Rounder term_, q_, alpha_, transmittance_, weight_, sum_;
    LookupTable sqrt_, exp_;
};

} // namespace degs
