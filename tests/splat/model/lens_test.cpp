// SPDX-License-Identifier: Apache-2.0
#include "splat/model/lens.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/splat/model/published_lens.hpp"

namespace degs {
namespace {

using Kind = LensCoefficients::Kind;
using test::published_lenses;
using test::PublishedLens;

Lens open_cv(double k1, double k2 = 0, double p1 = 0) {
    return PublishedLens{"", false, {k1, k2, p1}}.lens();
}

TEST(Lens, FollowsThePublishedFormulas) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const PublishedLens& published : published_lenses()) {
        SCOPED_TRACE(published.name);
        const Lens lens = published.lens();
        EXPECT_FALSE(lens.is_pinhole());
        EXPECT_TRUE(lens.is_sound());
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec2 slopes(1.2 * uniform(random), 1.2 * uniform(random));
            const auto [x, y] = published.slopes_of({slopes.x, slopes.y, 1});
            const glm::dvec2 bent = lens.bent(slopes);
            EXPECT_NEAR(bent.x, static_cast<double>(x), 1e-14);
            EXPECT_NEAR(bent.y, static_cast<double>(y), 1e-14);
        }
        const glm::dvec2 middle = lens.bent({0, 0});
        EXPECT_EQ(middle.x, 0);
        EXPECT_EQ(middle.y, 0);
    }
}

// The radial profile rises up to the fold and, if the fold lies before the steepest slope, falls
// behind it.
TEST(Lens, FoldsWhereItsProfileTurns) {
    // 1 + 3 k q = 0
    EXPECT_NEAR(open_cv(-0.12).fold_slope(), std::sqrt(1 / 0.36), 1e-12);
    EXPECT_EQ(open_cv(0.3, 0.1).fold_slope(), Lens::kMostSlope);
    EXPECT_EQ(Lens().fold_slope(), Lens::kMostSlope);
    // t + k t^3: 1 + 3 k t^2 = 0
    const Lens fisheye = PublishedLens{"", true, {-0.2}}.lens();
    EXPECT_NEAR(std::atan(fisheye.fold_slope()), std::sqrt(1 / 0.6), 1e-12);
    for (const PublishedLens& published : published_lenses()) {
        SCOPED_TRACE(published.name);
        const Lens lens = published.lens();
        const double end = lens.fold_slope();
        double before = 0;
        for (int i = 1; i <= 1000; ++i) {
            const double radius = lens.radius_at(end * i / 1000);
            EXPECT_GT(radius, before);
            before = radius;
        }
    }
}

// Two different directions within the fold never share a point, tangential terms included.
TEST(Lens, IsOneToOneUpToItsFold) {
    const Lens lens = open_cv(-0.1, 0, 0.02);
    const double end = lens.fold_slope();
    EXPECT_LT(end, open_cv(-0.1).fold_slope());
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-end, end);
    int pairs = 0;
    while (pairs < 20000) {
        const glm::dvec2 a(uniform(random), uniform(random));
        const glm::dvec2 step(1e-4 * uniform(random), 1e-4 * uniform(random));
        if (glm::length(a) > end || glm::length(a + step) > end) {
            continue;
        }
        // The Jacobian is positive definite: a step never goes back.
        EXPECT_GT(glm::dot(lens.bent(a + step) - lens.bent(a), step), 0);
        ++pairs;
    }
}

TEST(Lens, InvertsItsProfile) {
    for (const PublishedLens& published : published_lenses()) {
        const Lens lens = published.lens();
        for (const double slope : {1e-3, 0.2, 0.7}) {
            EXPECT_NEAR(lens.slope_at(lens.radius_at(slope)), slope, 1e-12) << published.name;
        }
        EXPECT_EQ(lens.slope_at(1e40), lens.fold_slope());
    }
}

TEST(Lens, WithoutCoefficientsIsAPinhole) {
    EXPECT_TRUE(open_cv(0).is_pinhole());
    EXPECT_EQ(open_cv(0), Lens());
    EXPECT_FALSE((PublishedLens{"", true, {}}.lens().is_pinhole()));
}

TEST(Lens, HostileCoefficientsFoldAtOnceOrNever) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    for (const double k : {nan, infinite, -infinite, -1e300, 1e300, -1e-300}) {
        for (const bool fisheye : {false, true}) {
            const Lens lens = PublishedLens{"", fisheye, {k}}.lens();
            EXPECT_EQ(lens.is_sound(), std::isfinite(k));
            EXPECT_GE(lens.fold_slope(), 0);
            EXPECT_LE(lens.fold_slope(), Lens::kMostSlope);
            if (!(k >= -1)) {
                EXPECT_LT(lens.fold_slope(), 1e-100) << k;
            }
        }
    }
    LensCoefficients poles;
    poles.kind = Kind::OpenCv;
    poles.denominator = {-4, 0, 0}; // no value at r = 1/2
    EXPECT_LT(Lens(poles).fold_slope(), 0.5);
}

} // namespace
} // namespace degs
