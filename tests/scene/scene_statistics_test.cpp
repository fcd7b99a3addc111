// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_statistics.hpp"

#include <cmath>

#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

void add(GaussianCloud& cloud, const glm::dvec3& mean, const glm::vec3& scale, float opacity) {
    cloud.means.push_back(mean);
    cloud.scales.push_back(scale);
    cloud.rotations.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
    cloud.opacities.push_back(opacity);
    cloud.sh.insert(cloud.sh.end(), static_cast<std::size_t>(cloud.sh_coefficients()) * 3, 0.5F);
}

TEST(SceneStatisticsTest, QuantilesAreNearestRanks) {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i) {
        values.push_back(i);
    }
    const Quantiles q = quantiles_of(values);
    EXPECT_EQ(q.p10, 10);
    EXPECT_EQ(q.p50, 50);
    EXPECT_EQ(q.p90, 90);
    EXPECT_EQ(q.p99, 99);
    std::vector<double> one{7};
    EXPECT_EQ(quantiles_of(one).p10, 7);
    std::vector<double> none;
    EXPECT_EQ(quantiles_of(none).p50, 0);
}

TEST(SceneStatisticsTest, DescribesShapesOpacitiesAndExtent) {
    GaussianCloud cloud;
    cloud.sh_degree = 1;
    for (int i = 0; i <= 100; ++i) { // axes in every order, ratio 2 and 4
        const float size = 0.01F * static_cast<float>(i + 1);
        const glm::vec3 axes[] = {{8, 4, 1}, {1, 8, 4}, {4, 1, 8}};
        add(cloud, {i, -2.0 * i, 5}, size * axes[i % 3], i < 50 ? 0.001F : 0.95F);
    }
    SanitizeReport dropped;
    dropped.bad_scale = 3;
    const SceneStatistics s = measure_scene(cloud, dropped);
    EXPECT_EQ(s.gaussians, 101U);
    EXPECT_EQ(s.sh_degree, 1);
    EXPECT_EQ(s.dropped.bad_scale, 3U);
    EXPECT_NEAR(s.anisotropy.p10, 8, 1e-5);
    EXPECT_NEAR(s.flatness.p50, 4, 1e-5);
    EXPECT_NEAR(s.elongation.p99, 2, 1e-5);
    EXPECT_NEAR(s.largest_axis.p50, 0.51 * 8, 1e-5);
    EXPECT_NEAR(s.largest_axis_max, 1.01 * 8, 1e-5);
    EXPECT_NEAR(s.faint_share, 50.0 / 101, 1e-12);
    EXPECT_NEAR(s.opaque_share, 51.0 / 101, 1e-12);
    EXPECT_GT(s.opacity_size_correlation, 0.7); // the later ones are bigger and opaque
    EXPECT_NEAR(s.sh_rest_rms, 0.5, 1e-12);
    EXPECT_EQ(s.low, glm::dvec3(1, -198, 5));
    EXPECT_EQ(s.high, glm::dvec3(99, -2, 5));
}

TEST(SceneStatisticsTest, SurvivesAnEmptyAndAFlatScene) {
    GaussianCloud cloud;
    EXPECT_EQ(measure_scene(cloud).anisotropy.p50, 0);
    add(cloud, {0, 0, 0}, {1, 1, 0}, 0.5F);
    EXPECT_TRUE(std::isfinite(measure_scene(cloud).anisotropy.p50));
    EXPECT_GT(measure_scene(cloud).anisotropy.p50, 1e30);
}

TEST(SceneStatisticsTest, ViewsCountLikeTheReferenceRenderer) {
    GaussianCloud cloud;
    add(cloud, {0, 0, 0}, glm::vec3(0.1F), 0.9F);
    Camera camera;
    camera.width = 200;
    camera.height = 160;
    camera.fx = camera.fy = 200;
    camera.position = {0, 0, -2};
    const ViewStatistics view = measure_view(cloud, camera);
    EXPECT_EQ(view.visible, 1U);
    EXPECT_EQ(view.candidates, view.fragments); // alone, nothing hides it
    // A circle of sigma = sqrt(10^2 + 0.3) px and Q_th = 2 ln(255 * 0.9).
    const double radius = std::sqrt(100.3 * 2 * std::log(255 * 0.9));
    EXPECT_NEAR(view.footprint.p50, 2 * radius, 0.01);
    EXPECT_NEAR(static_cast<double>(view.fragments), 3.14159265 * radius * radius, radius);
    EXPECT_NEAR(view.fragments_per_pixel, static_cast<double>(view.fragments) / 32000, 1e-12);
    // Transmittance 1 - 0.9 exp(-q/2) is below one half for q < 2 ln 1.8.
    EXPECT_NEAR(view.covered_share * 32000, 3.14159265 * 100.3 * 2 * std::log(1.8), 15);
    EXPECT_EQ(view.terminated_share, 0);
    for (int i = 0; i < 20; ++i) {
        add(cloud, {0, 0, 0.1}, glm::vec3(0.1F), 0.9F);
    }
    const ViewStatistics stacked = measure_view(cloud, camera);
    EXPECT_GT(stacked.terminated_share, 0);
    EXPECT_GT(stacked.candidates, stacked.fragments);
}

} // namespace
} // namespace degs
