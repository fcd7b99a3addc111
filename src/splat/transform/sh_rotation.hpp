// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <glm/glm.hpp>

namespace degs {

/// Turns colours with their Gaussian: the rotated coefficients c' satisfy
/// sum c'_k Y_k(d) = sum c_k Y_k(R^T d) for every direction d, in the basis of sh_basis().
/// A band maps to itself, so the matrix consists of blocks of 3, 5 and 7 rows.
class ShRotation {
public:
    /// `rotation` is orthonormal, with determinant +1; degree 0..3. The elements are exact up to
    /// double rounding.
    ShRotation(int degree, const glm::dmat3& rotation);
    /// `coefficients` is [coefficient][channel], as in GaussianCloud::sh. Sums in double, rounds
    /// once.
    void apply(float* coefficients) const;

private:
    static constexpr int kBands = 4;
    static constexpr int kWidest = 7;
    using Block = std::array<std::array<double, kWidest>, kWidest>;

    int degree_;
    std::array<Block, kBands> blocks_{}; ///< of degree 1..3; [to][from], the first 2 l + 1 of each
};

} // namespace degs
