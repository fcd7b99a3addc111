// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "splat/pixels/quantized_row.hpp"

namespace degs {

/// Side of the window of the paper's test (Sec. V-B, Fig. 7).
constexpr int kAlphaWindow = 32;

/// alpha of a window's pixels, row by row; 0 where it is below 1/255 or no span covers the pixel.
struct AlphaMap {
    std::vector<double> alpha = std::vector<double>(kAlphaWindow * kAlphaWindow, 0.0);
    double& at(int x, int y) { return alpha[y * kAlphaWindow + x]; }
};

/// A window's first pixel.
struct WindowCorner {
    int x = 0, y = 0;
};

/// Eq. 5 and 6 pixel by pixel, as the original rasteriser writes them; parameters, and every
/// operation, rounded to `format`. The reference is fp64.
AlphaMap direct_alpha(const ProjectedSplat& splat, WindowCorner corner, const NumberFormat& format);

/// The row path of DeGS: spans, closed-form q_n, alpha.
AlphaMap row_alpha(const ProjectedSplat& splat, WindowCorner corner, const QuantizedRow& path);

/// Distance between maps, summed over Gaussians.
struct AlphaError {
    std::uint64_t gaussians = 0;
    std::uint64_t support = 0;   ///< pixels with alpha >= 1/255 in the reference
    std::uint64_t flips = 0;     ///< pixels that only one of the maps has
    std::uint64_t nonfinite = 0; ///< pixels that are NaN
    double max = 0;              ///< largest |difference| of pixels that both maps have
    std::vector<double> means;   ///< of each Gaussian: mean |difference| of all 1024 pixels

    void add(const AlphaMap& reference, const AlphaMap& map);
    double mean() const;
    /// Standard deviation of the Gaussians' means.
    double spread() const;
};

/// A splat in the window whose corner is (0, 0): standard deviations in px along its axes, the
/// major one turned by `angle`; dilation is not added.
ProjectedSplat window_splat(double x, double y, double major, double minor, double angle,
                            double opacity);
/// sigma 3 px, opacity 1, the centre anywhere in the middle pixel.
ProjectedSplat isotropic_splat(std::mt19937_64& random);
/// sigma 1 .. 12 px, aspect up to 6, opacity 0.1 .. 1, the centre in the window's middle half.
ProjectedSplat random_window_splat(std::mt19937_64& random);
/// The window of the raster's 32 x 32 grid that contains the splat's mean, or the nearest one with
/// a pixel of the image.
WindowCorner window_of(const ProjectedSplat& splat, const PixelBox& image);

} // namespace degs
