// SPDX-License-Identifier: Apache-2.0
#include "splat/model/gaussian.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Sanitize, LeavesAGoodCloudAloneBitForBit) {
    GaussianCloud cloud = test::random_cloud(500, 3, 3);
    const GaussianCloud before = cloud;
    EXPECT_EQ(sanitize(cloud).total(), 0U);
    EXPECT_EQ(cloud.means, before.means);
    EXPECT_EQ(cloud.scales, before.scales);
    EXPECT_EQ(cloud.opacities, before.opacities);
    EXPECT_EQ(cloud.sh, before.sh);
    const GaussianCloud once = cloud;
    sanitize(cloud);
    EXPECT_EQ(cloud.rotations, once.rotations); // twice is once
}

TEST(Sanitize, CountsEveryDefectUnderItsReason) {
    const auto report_of = [](const std::function<void(GaussianCloud&)>& damage) {
        GaussianCloud cloud = test::random_cloud(3, 4, 1);
        damage(cloud);
        const SanitizeReport report = sanitize(cloud);
        EXPECT_EQ(cloud.size() + report.total(), 3U);
        return report;
    };
    for (const float bad : {kNan, kInf, -kInf}) {
        const auto non_finite = [&](const std::function<void(GaussianCloud&)>& damage) {
            EXPECT_EQ(report_of(damage).non_finite, 1U);
        };
        non_finite([&](GaussianCloud& c) { c.means[1].z = static_cast<double>(bad); });
        non_finite([&](GaussianCloud& c) { c.scales[1].y = bad; });
        non_finite([&](GaussianCloud& c) { c.rotations[1].w = bad; });
        non_finite([&](GaussianCloud& c) { c.opacities[1] = bad; });
        non_finite([&](GaussianCloud& c) { c.sh[12 + 11] = bad; });
    }
    EXPECT_EQ(report_of([](GaussianCloud& c) { c.rotations[0] = glm::vec4(0); }).zero_rotation, 1U);
    EXPECT_EQ(report_of([](GaussianCloud& c) { c.rotations[0] = glm::vec4(-0.0F); }).zero_rotation,
              1U);
    EXPECT_EQ(report_of([](GaussianCloud& c) { c.scales[2].x = -1e-30F; }).bad_scale, 1U);
    EXPECT_EQ(report_of([](GaussianCloud& c) { c.scales[2].x = 0; }).total(), 0U);
    EXPECT_EQ(report_of([](GaussianCloud& c) { c.opacities[2] = -1e-9F; }).bad_opacity, 1U);
    EXPECT_EQ(report_of([](GaussianCloud& c) { c.opacities[2] = 1.0000001F; }).bad_opacity, 1U);
    EXPECT_EQ(report_of([](GaussianCloud& c) { c.opacities = {0, 1, 0.5F}; }).total(), 0U);
}

TEST(Sanitize, CountsAGaussianOnce) {
    GaussianCloud cloud = test::random_cloud(1, 5);
    cloud.means[0].x = static_cast<double>(kNan);
    cloud.rotations[0] = glm::vec4(0);
    cloud.scales[0].x = -1;
    cloud.opacities[0] = 2;
    EXPECT_EQ(sanitize(cloud).total(), 1U);
    EXPECT_TRUE(cloud.empty());
    EXPECT_TRUE(cloud.sh.empty());
}

TEST(Sanitize, KeepsTheOrderOfTheRest) {
    GaussianCloud cloud = test::random_cloud(100, 6, 2);
    const GaussianCloud before = cloud;
    for (std::size_t i = 0; i < 100; i += 3) {
        cloud.opacities[i] = kNan;
    }
    EXPECT_EQ(sanitize(cloud).non_finite, 34U);
    ASSERT_EQ(cloud.size(), 66U);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const std::size_t from = i / 2 * 3 + i % 2 + 1;
        EXPECT_EQ(cloud.means[i], before.means[from]);
        EXPECT_EQ(cloud.scales[i], before.scales[from]);
        EXPECT_EQ(cloud.opacities[i], before.opacities[from]);
        for (std::size_t k = 0; k < 27; ++k) {
            EXPECT_EQ(cloud.sh_of(i)[k], before.sh_of(from)[k]);
        }
    }
}

TEST(Sanitize, ExplainsWhatItDropped) {
    SanitizeReport report;
    report.non_finite = 1200;
    report.zero_rotation = 30;
    report.bad_scale = 4;
    EXPECT_EQ(report.explain(),
              "1 234 Gaussians of the file cannot be drawn and were dropped: 1 200 hold NaN or "
              "infinity, 30 a rotation of length zero, 4 a negative scale, 0 an opacity outside 0 "
              "to 1.");
}

TEST(Sanitize, NormalisesQuaternionsOfAnyLength) {
    for (const double length : {1e-37, 1e-20, 0.3, 1.0, 1.00001, 7.0, 1e20, 1.7e38}) {
        GaussianCloud cloud = test::random_cloud(1, 7);
        const glm::dvec4 direction(0.1, -0.7, 0.5, 0.5);
        const glm::vec4 raw(direction * length);
        cloud.rotations[0] = raw;
        EXPECT_EQ(sanitize(cloud).total(), 0U);
        const glm::dvec4 exact = glm::normalize(glm::dvec4(raw));
        for (int k = 0; k < 4; ++k) {
            EXPECT_NEAR(cloud.rotations[0][k], exact[k], 1.2e-7) << length;
        }
    }
}

} // namespace
} // namespace degs
