// SPDX-License-Identifier: Apache-2.0
#include "splat/model/spherical_harmonics.hpp"

#include "splat/model/sh_evaluation.hpp"

namespace degs {
namespace {

using Double = MachineNumbers<double>;

} // namespace

std::array<double, kMaxShCoefficients> sh_basis(int degree, const glm::dvec3& direction) {
    const Double numbers;
    return ShBasis<Double>(numbers, degree, vector_in(numbers, direction)).values();
}

template Vector3<double> evaluate_sh(const Double&, int, const float*, const Vector3<double>&);
template Vector3<float> evaluate_sh(const MachineNumbers<float>&, int, const float*,
                                    const Vector3<float>&);
template Vector3<Rounded> evaluate_sh(const RoundedNumbers&, int, const float*,
                                      const Vector3<Rounded>&);

glm::dvec3 evaluate_sh(int degree, const float* coefficients, const glm::dvec3& direction) {
    const Double numbers;
    const Vector3<double> sum =
        evaluate_sh(numbers, degree, coefficients, vector_in(numbers, direction));
    return {sum.x, sum.y, sum.z};
}

std::string explain_sh(int degree) {
    if (degree == kMaxShDegree) {
        return "The scene has all SH bands (degree 3): nothing of the colour is left out.";
    }
    const int left_out = 3 * (kMaxShCoefficients - (degree + 1) * (degree + 1));
    return "The scene has SH degree " + std::to_string(degree) + ": the " +
           std::to_string(left_out) +
           " coefficients of higher bands are neither read nor evaluated.";
}

} // namespace degs
