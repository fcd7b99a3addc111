// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/frame/pixel_index.hpp"
#include "splat/pixels/quantized_row.hpp"

namespace degs {

/// Bounds on the distance of QuantizedRow::solve from the ellipse of its record, for a number set.
///
/// The record describes an ellipse exactly: |x - mu_x - m dy| <= r_x sqrt(1 - dy^2 /
/// r_y^2). The Span Unit rounds x = dy^2 / r_y^2 and looks the root up, which is a slightly
/// larger ellipse, and rounds x_c and the ends, which moves them. Each rounding counts with
/// half a unit of its format at the largest value that it can see; where that leaves the
/// format, only the rows are known.
class QuantizedSlack {
public:
    explicit QuantizedSlack(const NumberSet& set);

    /// Bound on x - dy^2 / r_y^2, and what a table of cells adds to it; |dy| <= `reach`.
    double ratio(const QuantizedSplat& splat, double reach) const;
    /// Bound on the distance of an end from the larger ellipse's, px.
    double ends(const QuantizedSplat& splat, double reach) const;

private:
    /// Largest error of rounding a value of some magnitude, for one format.
    class RoundingError {
    public:
        explicit RoundingError(const NumberFormat& format);
        /// Infinite if the magnitude is beyond the format.
        double of(double magnitude) const;

    private:
        double most_, least_, share_;
    };

    RoundingError distance_, square_, ratio_, edge_;
    bool squared_;
    double cell_ = 0, root_ = 0; // of the root: as an error of x, as one of the result
    double outward_ = 0;         // px that the set's ends lie outside
};

/// Rows and columns that the spans of a splat may touch. Rows are those that the Span Unit accepts,
/// to the last rounding; columns and rows_in_columns() may name a few too many, never one too few.
class QuantizedExtent {
public:
    /// The extent of no splat.
    QuantizedExtent() = default;
    QuantizedExtent(const QuantizedRow& row, const QuantizedSlack& slack,
                    const QuantizedSplat& splat);

    const PixelRange& rows() const { return rows_; }
    const PixelRange& columns() const { return columns_; }
    /// See DataPath::rows_in_columns.
    PixelRange rows_in_columns(int x_begin, int x_end) const;

private:
    static PixelRange rows_of(const QuantizedRow& row, const QuantizedSplat& splat, double centre);
    int cut(double dx, int direction) const;

    PixelRange rows_, columns_;
    bool bounded_ = false; // the ellipse below is known to hold the spans
    double x_ = 0, y_ = 0; // centre
    double slope_ = 0;     // m
    double radius_ = 0;    // of the larger ellipse: r_x
    double inverse_ = 0;   // 1 / r_y^2
    double steepness_ = 0; // m^2 + r_x^2 / r_y^2
    double margin_ = 0;    // px
};

} // namespace degs
