// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "splat/frame/projection.hpp"
#include "splat/numbers/number_format.hpp"

namespace degs {

/// The exponents of a tile's pixels as a product of matrices, as ORANGE forms them (Li et al., HPCA
/// 2026): every splat is a row of kGemmDepth coefficients, every pixel a column of as many
/// monomials of its coordinates,
///
///     q' = v . (x^2, y^2, x y, x, y, 1),   x, y from an origin of the whole product.
///
/// It is q - 2 ln o of the same conic A, B, C as everywhere, multiplied out. The terms are larger
/// than their sum by the square of the distance from the origin to the splat, in standard
/// deviations, and their rounding stays in q'.
constexpr int kGemmDepth = 6;

/// Where x = y = 0. `Tile`: at the pixel in the middle of the tile, so that the coefficients of a
/// splat are those of one tile. `Image`: at the first pixel of the image, so that one row of
/// coefficients serves all tiles.
enum class GemmOrigin { Tile, Image };

struct ExponentGemm {
    GemmOrigin origin = GemmOrigin::Tile;
    /// Formats of a number set: coefficients and monomials; products and their sums. Single and
    /// double precision use their own.
    NumberFormat operands, sums;
};

template <class T>
using GemmRow = std::array<T, kGemmDepth>;

/// The parameters from which the coefficients of a splat are formed: mean, conic, each rounded
/// once, and 2 ln o.
template <class T>
struct GemmSplat {
    int pixel_x = 0, pixel_y = 0; ///< nearest to the mean
    T offset_x = 0, offset_y = 0; ///< of the mean from that pixel, px
    T a = 0, b = 0, c = 0;        ///< q = a x^2 + 2 b x y + c y^2
    T fold = 0;                   ///< 2 ln o
    bool cut = false;             ///< a cut ends the splat, see ProjectedSplat::q_end

    /// The coefficients for an origin, image px. Every operation is rounded to T, in the order in
    /// which it is written.
    GemmRow<T> row(int origin_x, int origin_y) const {
        const T dx = static_cast<T>(pixel_x - origin_x) + offset_x;
        const T dy = static_cast<T>(pixel_y - origin_y) + offset_y;
        const T twice_b = 2 * b;
        const T level = a * dx * dx + twice_b * dx * dy + c * dy * dy;
        return {a, c, twice_b, -2 * (a * dx + b * dy), -2 * (b * dx + c * dy), level - fold};
    }
    /// What q' may lie above the limit of a splat that is cut because its terms are rounded, for
    /// pixels at most `reach_x` and `reach_y` from the origin. The terms add up to
    /// 2 (a X^2 + c Y^2) at most, X and Y the sums of the distances of pixel and mean from the
    /// origin, and less than eight roundings follow each other. Where the terms are so large that
    /// this would move the edge visibly, their rounding stays.
    T margin(int origin_x, int origin_y, int reach_x, int reach_y) const {
        constexpr T kMost = T(0x1p-8);
        const T x =
            std::abs(static_cast<T>(pixel_x - origin_x) + offset_x) + static_cast<T>(reach_x);
        const T y =
            std::abs(static_cast<T>(pixel_y - origin_y) + offset_y) + static_cast<T>(reach_y);
        const T terms = 2 * (a * x * x + c * y * y) + std::abs(fold);
        return std::min(kMost, 4 * std::numeric_limits<T>::epsilon() * terms);
    }
};

/// `pixel`: nearest to the mean, image px.
template <class T>
GemmSplat<T> gemm_splat(const ProjectedSplat& splat, int pixel_x, int pixel_y, double fold) {
    GemmSplat<T> out;
    out.pixel_x = pixel_x;
    out.pixel_y = pixel_y;
    out.offset_x = static_cast<T>(splat.mu_x - pixel_x);
    out.offset_y = static_cast<T>(splat.mu_y - pixel_y);
    out.a = static_cast<T>(splat.cov_c / splat.det);
    out.b = static_cast<T>(-splat.cov_b / splat.det);
    out.c = static_cast<T>(splat.cov_a / splat.det);
    out.fold = static_cast<T>(fold);
    out.cut = splat.q_cut_off > 0;
    return out;
}

/// The monomials of a pixel.
template <class T>
GemmRow<T> gemm_monomials(T x, T y) {
    return {x * x, y * y, x * y, x, y, T(1)};
}

/// Sums the products in the order of the reduction, from the first coefficient on.
template <class T>
T gemm_product(const GemmRow<T>& coefficients, const GemmRow<T>& monomials) {
    T sum = coefficients[0] * monomials[0];
    for (std::size_t k = 1; k < coefficients.size(); ++k) {
        sum = sum + coefficients[k] * monomials[k];
    }
    return sum;
}

/// The origin of a product whose pixels begin at a tile's corner, image px.
inline int gemm_origin(const ExponentGemm& gemm, int corner, int tile_size) {
    return gemm.origin == GemmOrigin::Image ? 0 : corner + tile_size / 2;
}

} // namespace degs
