// SPDX-License-Identifier: Apache-2.0
#include "splat/transform/sh_rotation.hpp"

#include <cmath>

#include "splat/model/angles.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

/// Calls `visit(direction, weight)` for a quadrature of the sphere that integrates polynomials up
/// to degree 7 without error: Gauss-Legendre in z, equal steps of the azimuth. Products of two
/// functions of degree 3 have degree 6.
template <class Visit>
void for_each_quadrature_point(const Visit& visit) {
    constexpr int kAzimuths = 8;
    constexpr std::array<std::array<double, 2>, 4> kHeights{{
        {-0.8611363115940526, 0.3478548451374538},
        {-0.3399810435848563, 0.6521451548625461},
        {0.3399810435848563, 0.6521451548625461},
        {0.8611363115940526, 0.3478548451374538},
    }};
    const double step = 2 * kPi / kAzimuths;
    for (const auto& [z, weight] : kHeights) {
        const double radius = std::sqrt(1 - z * z);
        for (int i = 0; i < kAzimuths; ++i) {
            visit(glm::dvec3(radius * std::cos(i * step), radius * std::sin(i * step), z),
                  weight * step);
        }
    }
}

} // namespace

ShRotation::ShRotation(int degree, const glm::dmat3& rotation) : degree_(degree) {
    const glm::dmat3 inverse = glm::transpose(rotation);
    for_each_quadrature_point([&](const glm::dvec3& direction, double weight) {
        const auto here = sh_basis(degree_, direction);
        const auto there = sh_basis(degree_, inverse * direction);
        for (int l = 1; l <= degree_; ++l) {
            for (int to = 0; to <= 2 * l; ++to) {
                for (int from = 0; from <= 2 * l; ++from) {
                    blocks_[l][to][from] += weight * here[l * l + to] * there[l * l + from];
                }
            }
        }
    });
}

void ShRotation::apply(float* coefficients) const {
    for (int l = 1; l <= degree_; ++l) {
        float* const band = coefficients + l * l * 3;
        const int rows = 2 * l + 1;
        std::array<double, kWidest * 3> turned{};
        for (int to = 0; to < rows; ++to) {
            for (int from = 0; from < rows; ++from) {
                const double factor = blocks_[l][to][from];
                for (int channel = 0; channel < 3; ++channel) {
                    turned[to * 3 + channel] += factor * band[from * 3 + channel];
                }
            }
        }
        for (int i = 0; i < rows * 3; ++i) {
            band[i] = static_cast<float>(turned[i]);
        }
    }
}

} // namespace degs
