// SPDX-License-Identifier: Apache-2.0
// The filters of FLIP, row by row. Internal to flip_difference.
#pragma once

#include <vector>

#include "splat/images/image.hpp"

namespace degs {

/// One-dimensional filters of 2 radius + 1 taps. All filters of FLIP are sums of products of one
/// along the row and one along the column.
struct FlipKernels {
    using Taps = std::vector<float>;
    explicit FlipKernels(double pixels_per_degree);

    int radius = 0;
    // Contrast sensitivity: a Gaussian each, of blue-yellow the sum of two with these weights.
    Taps achromatic, red_green, blue_yellow_narrow, blue_yellow_wide;
    float narrow_weight = 0, wide_weight = 0;
    // Features: a Gaussian, its first and its second derivative.
    Taps smooth, edge, point;
};

/// A filtered row: YCxCz as contrast sensitivity leaves it, and how strong edges and points are.
struct FlipRow {
    std::vector<float> y, cx, cz, edge, point;
};

/// Filters an image row by row, from the top; keeps as many rows as the filters are high.
class FlipFilter {
public:
    FlipFilter(const Image& image, const FlipKernels& kernels);
    /// The next row.
    const FlipRow& next();

private:
    /// Filtered along the row only.
    struct Planes {
        std::vector<float> achromatic, red_green, narrow, wide, smooth, edge, point;
    };
    void read_row(int row);
    void along_row(const std::vector<float>& padded, const FlipKernels::Taps& taps,
                   std::vector<float>& out) const;
    void along_column(std::vector<float> Planes::*plane, const FlipKernels::Taps& taps,
                      float weight, std::vector<float>& sum) const;

    const Image& image_;
    const FlipKernels& kernels_;
    std::size_t width_;
    int row_ = 0;  // the next to hand out
    int read_ = 0; // rows filtered along the row so far
    std::vector<float> padded_[3];
    std::vector<Planes> ring_; // row y at y mod height of the filters
    std::vector<float> across_, down_;
    FlipRow out_;
};

} // namespace degs
