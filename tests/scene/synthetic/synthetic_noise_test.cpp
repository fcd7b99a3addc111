// SPDX-License-Identifier: Apache-2.0
#include "scene/synthetic/synthetic_noise.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace degs {
namespace {

TEST(LatticeNoise, IsSmoothAndFillsItsRange) {
    constexpr double kStep = 1e-4;
    double low = 1;
    double high = 0;
    for (int i = -4000; i < 4000; ++i) {
        const glm::dvec3 at(0.0371 * i, -0.0137 * i, 0.0213 * i);
        const double value = lattice_noise(at);
        low = std::min(low, value);
        high = std::max(high, value);
        // Each axis changes by at most 1.5 per unit: the steepest slope of t^2 (3 - 2 t).
        EXPECT_LE(std::abs(lattice_noise(at + glm::dvec3(kStep, 0, 0)) - value),
                  1.5 * kStep + 1e-12);
        EXPECT_LE(std::abs(lattice_noise(at + glm::dvec3(0, kStep, 0)) - value),
                  1.5 * kStep + 1e-12);
    }
    EXPECT_GE(low, 0);
    EXPECT_LT(low, 0.1);
    EXPECT_LT(high, 1);
    EXPECT_GT(high, 0.9);
}

TEST(LatticeNoise, GoesThroughItsLattice) {
    for (const int x : {-3, 0, 17}) {
        const double at = lattice_noise({x, 2, 5});
        EXPECT_NEAR(lattice_noise({x + 1e-9, 2, 5}), at, 1e-12);
        EXPECT_NEAR(lattice_noise({x - 1e-9, 2, 5}), at, 1e-12);
        EXPECT_NE(lattice_noise({x, 3, 5}), at);
    }
}

} // namespace
} // namespace degs
