// SPDX-License-Identifier: Apache-2.0
#include "splat/spherical_harmonics.hpp"

namespace degs {
namespace {

using Basis = std::array<double, kMaxShCoefficients>;

void fill_degree_1(const glm::dvec3& d, Basis& basis) {
    constexpr double kY1 = 0.4886025119029199; // sqrt(3 / (4 pi))
    basis[1] = -kY1 * d.y;
    basis[2] = kY1 * d.z;
    basis[3] = -kY1 * d.x;
}

void fill_degree_2(const glm::dvec3& d, Basis& basis) {
    const double xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
    basis[4] = 1.0925484305920792 * d.x * d.y;
    basis[5] = -1.0925484305920792 * d.y * d.z;
    basis[6] = 0.31539156525252005 * (2 * zz - xx - yy);
    basis[7] = -1.0925484305920792 * d.x * d.z;
    basis[8] = 0.5462742152960396 * (xx - yy);
}

void fill_degree_3(const glm::dvec3& d, Basis& basis) {
    const double xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
    basis[9] = -0.5900435899266435 * d.y * (3 * xx - yy);
    basis[10] = 2.890611442640554 * d.x * d.y * d.z;
    basis[11] = -0.4570457994644658 * d.y * (4 * zz - xx - yy);
    basis[12] = 0.3731763325901154 * d.z * (2 * zz - 3 * xx - 3 * yy);
    basis[13] = -0.4570457994644658 * d.x * (4 * zz - xx - yy);
    basis[14] = 1.445305721320277 * d.z * (xx - yy);
    basis[15] = -0.5900435899266435 * d.x * (xx - 3 * yy);
}

} // namespace

Basis sh_basis(int degree, const glm::dvec3& direction) {
    Basis basis{};
    basis[0] = 0.28209479177387814; // 1 / sqrt(4 pi)
    if (degree >= 1) {
        fill_degree_1(direction, basis);
    }
    if (degree >= 2) {
        fill_degree_2(direction, basis);
    }
    if (degree >= 3) {
        fill_degree_3(direction, basis);
    }
    return basis;
}

glm::dvec3 evaluate_sh(int degree, const float* coefficients, const glm::dvec3& direction) {
    const Basis basis = sh_basis(degree, direction);
    const int count = (degree + 1) * (degree + 1);
    glm::dvec3 sum(0.0);
    const float* rgb = coefficients;
    for (int k = 0; k < count; ++k, rgb += 3) {
        sum += basis[k] * glm::dvec3(rgb[0], rgb[1], rgb[2]);
    }
    return sum;
}

} // namespace degs
