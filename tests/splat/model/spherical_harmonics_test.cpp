// SPDX-License-Identifier: Apache-2.0
#include "splat/model/spherical_harmonics.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "splat/model/angles.hpp"

namespace degs {
namespace {

/// Integral over the sphere of Y_j Y_k: Gauss-Legendre in z (exact to degree 9), equal steps in the
/// azimuth (exact for frequencies below 16); the products have degree 6 at most.
double inner_product(int j, int k) {
    const double near = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3;
    const double far = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
    const double near_weight = (322 + 13 * std::sqrt(70.0)) / 900;
    const double far_weight = (322 - 13 * std::sqrt(70.0)) / 900;
    const double nodes[] = {-far, -near, 0, near, far};
    const double weights[] = {far_weight, near_weight, 128.0 / 225, near_weight, far_weight};
    double sum = 0;
    for (int i = 0; i < 5; ++i) {
        for (int step = 0; step < 16; ++step) {
            const double azimuth = 2 * kPi * step / 16;
            const double r = std::sqrt(1 - nodes[i] * nodes[i]);
            const auto basis =
                sh_basis(3, {r * std::cos(azimuth), r * std::sin(azimuth), nodes[i]});
            sum += weights[i] * 2 * kPi / 16 * basis[j] * basis[k];
        }
    }
    return sum;
}

TEST(SphericalHarmonics, BasisIsOrthonormal) {
    for (int j = 0; j < kMaxShCoefficients; ++j) {
        for (int k = 0; k <= j; ++k) {
            EXPECT_NEAR(inner_product(j, k), j == k ? 1 : 0, 1e-14) << j << " " << k;
        }
    }
}

// Orthonormality says nothing about signs and order: each function at a direction where it is
// known.
TEST(SphericalHarmonics, SignsFollowCondonShortley) {
    const double s = std::sqrt(0.5), t = std::sqrt(1.0 / 3);
    EXPECT_NEAR(sh_basis(3, {0, 0, 1})[0], std::sqrt(1 / (4 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {0, 1, 0})[1], -std::sqrt(3 / (4 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {0, 0, 1})[2], std::sqrt(3 / (4 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {1, 0, 0})[3], -std::sqrt(3 / (4 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {s, s, 0})[4], std::sqrt(15 / (16 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {0, s, s})[5], -std::sqrt(15 / (16 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {0, 0, 1})[6], std::sqrt(5 / (4 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {s, 0, s})[7], -std::sqrt(15 / (16 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {1, 0, 0})[8], std::sqrt(15 / (16 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {0, 1, 0})[9], std::sqrt(35 / (32 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {t, t, t})[10], std::sqrt(105 / (4 * kPi)) * t * t * t, 1e-15);
    EXPECT_NEAR(sh_basis(3, {0, 1, 0})[11], std::sqrt(21 / (32 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {0, 0, 1})[12], std::sqrt(7 / (4 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {1, 0, 0})[13], std::sqrt(21 / (32 * kPi)), 1e-15);
    EXPECT_NEAR(sh_basis(3, {s, 0, s})[14], std::sqrt(105 / (16 * kPi)) * s * s * s, 1e-15);
    EXPECT_NEAR(sh_basis(3, {1, 0, 0})[15], -std::sqrt(35 / (32 * kPi)), 1e-15);
}

TEST(SphericalHarmonics, LowerDegreesLeaveTheRestZero) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 2, 3));
    const auto full = sh_basis(3, direction);
    for (int degree = 0; degree <= 3; ++degree) {
        const auto basis = sh_basis(degree, direction);
        for (int k = 0; k < kMaxShCoefficients; ++k) {
            EXPECT_EQ(basis[k], k < (degree + 1) * (degree + 1) ? full[k] : 0) << degree;
        }
    }
}

TEST(SphericalHarmonics, CoefficientsAreInterleavedByChannel) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(-2, 1, 0.5));
    for (int degree = 0; degree <= 3; ++degree) {
        const int count = (degree + 1) * (degree + 1);
        for (int k = 0; k < count; ++k) {
            std::vector<float> coefficients(static_cast<std::size_t>(count) * 3, 0.0F);
            coefficients[static_cast<std::size_t>(k) * 3 + 1] = 2; // green only
            const glm::dvec3 sum = evaluate_sh(degree, coefficients.data(), direction);
            EXPECT_EQ(sum, glm::dvec3(0, 2 * sh_basis(degree, direction)[k], 0));
        }
    }
}

TEST(SphericalHarmonics, TheDegreeExplainsWhatIsLeftOut) {
    EXPECT_EQ(explain_sh(3),
              "The scene has all SH bands (degree 3): nothing of the colour is left out.");
    EXPECT_EQ(explain_sh(1), "The scene has SH degree 1: the 36 coefficients of higher bands are "
                             "neither read nor evaluated.");
    EXPECT_EQ(explain_sh(0), "The scene has SH degree 0: the 45 coefficients of higher bands are "
                             "neither read nor evaluated.");
}

} // namespace
} // namespace degs
