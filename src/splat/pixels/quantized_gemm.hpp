// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "splat/pixels/data_path.hpp"
#include "splat/pixels/quantized_row.hpp"

namespace degs {

/// Products with FP16 operands and single-precision sums, as tensor cores and arrays like them
/// have.
ExponentGemm half_precision_gemm(GemmOrigin origin);

/// Exponents of a number set as products of matrices (exponent_gemm.hpp). A vector unit forms
/// coefficients and monomials in single precision and rounds each once to the format of the
/// operands; every product and every sum is rounded to that of the sums, and the exponent to that
/// of q.
class QuantizedGemm {
public:
    /// `row` has the units of q; without `gemm` nothing is kept.
    QuantizedGemm(const QuantizedRow& row, const std::optional<ExponentGemm>& gemm);

    bool wanted() const { return gemm_.has_value(); }
    void resize(std::size_t splats) { splats_.resize(wanted() ? splats : 0); }
    void set(std::size_t index, const ProjectedSplat& splat);
    /// q' of the pixels of a test, by bit of its mask. Not a number becomes the largest value of
    /// its format.
    void exponents(const PixelTest& test, int tile_size, double (&q)[32]) const;

private:
    std::optional<ExponentGemm> gemm_;
    double unit_;
    Rounder operand_, sum_, q_;
    std::vector<GemmSplat<float>> splats_;
};

} // namespace degs
