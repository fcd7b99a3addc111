// SPDX-License-Identifier: Apache-2.0
// The shared trained scenes: their published counts, and the numbers that synthetic scenes imitate.
#include <cmath>

#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/trained_bands.hpp"

namespace degs {
namespace {

/// A row of the README of the scenes.
struct Published {
    const char* name;
    std::uint64_t gaussians;
    int sh_degree;
    double anisotropy_p10, anisotropy_p50, anisotropy_p90;
    double median_opacity;
    double largest_axis_p50;
    glm::dvec3 extent;
};

/// Becomes part of the test's name.
void PrintTo(const Published& published, std::ostream* out) {
    *out << published.name;
}

class TrainedScene : public testing::TestWithParam<Published> {};

TEST_P(TrainedScene, HasItsPublishedStatistics) {
    const Published& published = GetParam();
    DEGS_NEEDS_SCENE(published.name);
    const Scene scene = load_scene((test::scenes() / published.name / "scene.ply").string());
    EXPECT_EQ(scene.name, published.name);
    EXPECT_EQ(scene.cameras.size(), 3U);
    EXPECT_EQ(scene.dropped.total(), 0U);
    const SceneStatistics s = measure_scene(scene.cloud, scene.dropped);
    EXPECT_EQ(s.gaussians, published.gaussians);
    EXPECT_EQ(s.sh_degree, published.sh_degree);
    const auto near = [](double a, double b) { EXPECT_NEAR(a / b, 1, 0.06) << a << " " << b; };
    near(s.anisotropy.p10, published.anisotropy_p10);
    near(s.anisotropy.p50, published.anisotropy_p50);
    near(s.anisotropy.p90, published.anisotropy_p90);
    near(s.opacity.p50, published.median_opacity);
    near(s.largest_axis.p50, published.largest_axis_p50);
    for (int axis = 0; axis < 3; ++axis) {
        near(s.high[axis] - s.low[axis], published.extent[axis]);
    }
}
INSTANTIATE_TEST_SUITE_P(
    Shared, TrainedScene,
    testing::Values(
        Published{"garden-crop", 138766, 0, 1, 1, 1, 0.1, 0.00969, {6.63, 5.70, 1.32}},
        Published{"skull", 94936, 3, 12, 1.2e5, 1.1e6, 0.165, 0.0205, {0.93, 1.03, 1.45}},
        Published{"flowers", 210422, 2, 5.6, 20.6, 71.8, 0.847, 0.00147, {0.56, 0.26, 0.56}},
        Published{"flowers-small", 26895, 2, 2.9, 69.3, 4.8e3, 0.357, 0.00202, {0.66, 0.37, 0.65}},
        Published{"st-peter", 133618, 0, 6.4, 60.2, 1.2e3, 0.302, 0.0147, {1.64, 3.46, 1.32}},
        Published{"guitar", 90854, 0, 6.2, 34.3, 332.5, 0.235, 0.0242, {1.17, 4.18, 1.30}},
        Published{"seal", 101780, 0, 4.5, 19.1, 88.1, 0.42, 0.0156, {2.63, 1.38, 2.62}},
        Published{"fruit-drops", 4721, 3, 3.7, 10.4, 44.9, 0.06, 0.00675, {0.45, 0.23, 0.06}}),
    [](const auto& row) {
        std::string name = row.param.name;
        name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
        return name;
    });

TEST(TrainedScenes, ExtraPropertiesChangeNothing) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const auto folder = test::scenes() / "fruit-drops";
    const GaussianCloud plain = load_scene((folder / "scene.ply").string()).cloud;
    const GaussianCloud extra = load_scene((folder / "source-extra-property.ply").string()).cloud;
    EXPECT_EQ(extra.means, plain.means);
    EXPECT_EQ(extra.scales, plain.scales);
    EXPECT_EQ(extra.rotations, plain.rotations);
    EXPECT_EQ(extra.opacities, plain.opacities);
    EXPECT_EQ(extra.sh, plain.sh);
}

TEST(TrainedScenes, KeepTheirRotationsNormalised) {
    DEGS_NEEDS_SCENE("seal");
    const GaussianCloud cloud = load_scene((test::scenes() / "seal" / "scene.ply").string()).cloud;
    for (const glm::vec4& q : cloud.rotations) {
        ASSERT_NEAR(glm::length(glm::dvec4(q)), 1, 1e-7);
    }
}

/// The bands that synthetic scenes are held against are what the trained scenes measure today.
void expect_bands(const std::vector<test::Band>& bands, const std::vector<const char*>& names) {
    std::vector<std::vector<test::Measured>> scenes;
    for (const char* const name : names) {
        scenes.push_back(
            test::measure_all(load_scene((test::scenes() / name / "scene.ply").string())));
        ASSERT_EQ(scenes.back().size(), bands.size());
    }
    for (std::size_t i = 0; i < bands.size(); ++i) {
        double low = scenes[0][i].value;
        double high = low;
        for (const auto& scene : scenes) {
            ASSERT_EQ(scene[i].name, bands[i].name);
            low = std::min(low, scene[i].value);
            high = std::max(high, scene[i].value);
        }
        EXPECT_NEAR(low, bands[i].low, 0.002 * low) << bands[i].name;
        EXPECT_NEAR(high, bands[i].high, 0.002 * high) << bands[i].name;
    }
}

TEST(LongTrainedScenes, MeasureAsDocumentedForObjects) {
    DEGS_NEEDS_SCENE("guitar");
    expect_bands(test::kObjectBands, {"skull", "st-peter", "guitar"});
}

TEST(LongTrainedScenes, MeasureAsDocumentedOutdoors) {
    DEGS_NEEDS_SCENE("flowers");
    expect_bands(test::kOutdoorBands, {"flowers", "seal"});
}

} // namespace
} // namespace degs
