// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/quantized_gemm.hpp"

#include <cmath>
#include <limits>

namespace degs {
namespace {

Rounder rounder_of(const std::optional<ExponentGemm>& gemm, NumberFormat ExponentGemm::*format) {
    return gemm ? Rounder((*gemm).*format) : Rounder();
}

} // namespace

ExponentGemm half_precision_gemm(GemmOrigin origin) {
    return {origin, parse_format("fp16"), parse_format("fp32")};
}

QuantizedGemm::QuantizedGemm(const QuantizedRow& row, const std::optional<ExponentGemm>& gemm)
    : gemm_(gemm), unit_(row.unit()), operand_(rounder_of(gemm, &ExponentGemm::operands)),
      sum_(rounder_of(gemm, &ExponentGemm::sums)), q_(row.set().q) {}

void QuantizedGemm::set(std::size_t index, const ProjectedSplat& splat) {
    if (!wanted()) {
        return;
    }
    const int x = index_within(std::nearbyint(splat.mu_x), -kFarPixel, kFarPixel);
    const int y = index_within(std::nearbyint(splat.mu_y), -kFarPixel, kFarPixel);
    splats_[index] = gemm_splat<float>(splat, x, y, 2.0 * std::log(splat.opacity));
}

void QuantizedGemm::exponents(const PixelTest& test, int tile_size, double (&q)[32]) const {
    const int origin_x = gemm_origin(*gemm_, test.x - test.column, tile_size);
    const int origin_y = gemm_origin(*gemm_, test.y - test.row, tile_size);
    const GemmRow<float> exact = splats_[test.splat].row(origin_x, origin_y);
    GemmRow<double> coefficients;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        coefficients[k] = operand_(unit_ * static_cast<double>(exact[k]));
    }
    const double y = test.y - origin_y;
    for (std::uint32_t left = test.mask; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const GemmRow<double> monomials = gemm_monomials<double>(test.x + i - origin_x, y);
        double sum = 0;
        for (std::size_t k = 0; k < coefficients.size(); ++k) {
            sum = sum_(sum + sum_(coefficients[k] * operand_(monomials[k])));
        }
        q[i] = std::isnan(sum) ? std::numeric_limits<double>::infinity() : q_(sum);
    }
}

} // namespace degs
