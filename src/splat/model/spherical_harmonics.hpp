// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "splat/model/vector3.hpp"
#include "splat/numbers/rounded.hpp"

namespace degs {

constexpr int kMaxShDegree = 3;
constexpr int kMaxShCoefficients = (kMaxShDegree + 1) * (kMaxShDegree + 1);
constexpr double kShY0 = 0.28209479177387814; ///< Y_0 = 1 / sqrt(4 pi), in every direction

/// Real spherical harmonics Y_k(direction) with the Condon-Shortley phase, k < (degree + 1)^2; the
/// rest is 0. `direction` has length 1. Order inside a degree: m = -l .. +l.
std::array<double, kMaxShCoefficients> sh_basis(int degree, const glm::dvec3& direction);

/// sum c_k Y_k(direction) per channel. `coefficients` is [coefficient][channel], as in
/// GaussianCloud::sh. The 0.5 that the 3DGS colour adds is not included.
glm::dvec3 evaluate_sh(int degree, const float* coefficients, const glm::dvec3& direction);

/// sum c_k Y_k(direction) in the arithmetic of `numbers`: coefficients and constants are rounded
/// once, and so is the result of every operation. Compiled for double, float and Rounded;
/// sh_evaluation.hpp has it for any scalar. Degree 0 does not read `direction`.
template <class Numbers>
Vector3<typename Numbers::Scalar> evaluate_sh(const Numbers& numbers, int degree,
                                              const float* coefficients,
                                              const Vector3<typename Numbers::Scalar>& direction);

/// One sentence: what a scene of this degree leaves out of the colours.
std::string explain_sh(int degree);

} // namespace degs
