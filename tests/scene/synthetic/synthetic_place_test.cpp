// SPDX-License-Identifier: Apache-2.0
// Profiles `interior` and `garden`, which stand for captures of whole places.
#include <string>

#include "degs/error.hpp"
#include "scene/scene_statistics.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kFew = 300000;

/// A view of a small level with a third of the pixels of each side.
ViewStatistics measure_small(const SyntheticScene& scene, std::size_t which) {
    Camera camera = scene.cameras.at(which);
    camera.width /= 3;
    camera.height /= 3;
    camera.fx /= 3;
    camera.fy /= 3;
    return measure_view(scene.cloud, camera);
}

// docs/regime.csv has the ranges of the real scenes: 97 to 100 % covered, 44 to 90 % ended early,
// 44 to 75 fragments per pixel and 6 to 60 % of the Gaussians visible.
TEST(LongSyntheticPlaces, HaveTheCountsOfRealCaptures) {
    for (const char* const profile : {"interior", "garden"}) {
        const SyntheticScene scene = make_synthetic({profile, kFew, 1});
        ASSERT_EQ(scene.cloud.size(), kFew);
        for (std::size_t which = 0; which < scene.cameras.size(); ++which) {
            const ViewStatistics view = measure_small(scene, which);
            const double visible = static_cast<double>(view.visible) / kFew;
            EXPECT_GT(view.covered_share, 0.97) << profile << which;
            EXPECT_GT(view.terminated_share, 0.44) << profile << which;
            EXPECT_LT(view.terminated_share, 0.90) << profile << which;
            EXPECT_GT(view.fragments_per_pixel, 35) << profile << which;
            EXPECT_LT(view.fragments_per_pixel, 75) << profile << which;
            EXPECT_GT(visible, 0.10) << profile << which;
            EXPECT_LT(visible, 0.60) << profile << which;
        }
    }
}

TEST(SyntheticPlaces, GiveSmallerSplatsToMoreGaussians) {
    const auto footprint = [](std::uint64_t gaussians) {
        return measure_small(make_synthetic({"interior", gaussians, 1}), 2).footprint.p50;
    };
    const double ratio = footprint(75000) / footprint(kFew);
    EXPECT_GT(ratio, 1.3);
    EXPECT_LT(ratio, 2);
}

TEST(SyntheticPlaces, AreDeterministic) {
    for (const char* const profile : {"interior", "garden"}) {
        const SyntheticScene once = make_synthetic({profile, 2000, 7});
        const SyntheticScene again = make_synthetic({profile, 2000, 7});
        EXPECT_EQ(once.cloud.means, again.cloud.means);
        EXPECT_EQ(once.cloud.scales, again.cloud.scales);
        EXPECT_EQ(once.cloud.rotations, again.cloud.rotations);
        EXPECT_EQ(once.cloud.opacities, again.cloud.opacities);
        EXPECT_EQ(once.cloud.sh, again.cloud.sh);
        EXPECT_NE(once.cloud.means, make_synthetic({profile, 2000, 8}).cloud.means);
    }
}

TEST(SyntheticPlaces, HaveAnyShareOfSkyOfLargeFaintSplats) {
    const SyntheticSpec spec = parse_synthetic("garden,gaussians=20000,sky=0.25");
    EXPECT_EQ(spec.sky, 0.25);
    const SyntheticScene scene = make_synthetic(spec);
    std::vector<double> faint;
    for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
        if (scene.cloud.means[i].y < 0 && glm::length(scene.cloud.means[i]) > 24.9) {
            faint.push_back(scene.cloud.opacities[i]);
        }
    }
    EXPECT_NEAR(static_cast<double>(faint.size()) / 20000, 0.25, 0.02);
    EXPECT_NEAR(quantiles_of(faint).p50, 0.04, 0.005);
}

// Upward from the courtyard: the whole image is sky. docs/regime.md names the capture with a sky.
TEST(SyntheticPlaces, NoPixelUnderTheSkyEndsEarly) {
    for (const char* const text :
         {"garden,gaussians=20000,sky=0.25", "garden,gaussians=300000,sky=0.1"}) {
        const SyntheticScene scene = make_synthetic(parse_synthetic(text));
        Camera camera = scene.cameras.at(1);
        camera.position = {0, -4.5, 0};
        constexpr double kHalf = 0.70710678118654752;
        camera.camera_to_world = glm::dmat3(1, 0, 0, 0, kHalf, kHalf, 0, -kHalf, kHalf);
        camera.width = 640;
        camera.height = 360;
        camera.fx = camera.fy = 512;
        const ViewStatistics view = measure_view(scene.cloud, camera);
        EXPECT_LE(view.terminated_share, 0.01) << text;
        EXPECT_GT(view.covered_share, 0.6) << text;
        EXPECT_GT(view.fragments_per_pixel, 25) << text;
        EXPECT_LT(view.fragments_per_pixel, 60) << text;
    }
}

TEST(SyntheticPlaces, RefuseHostileParametersInOneSentence) {
    for (const char* const text :
         {"interior,gaussians=0", "interior,sky=2", "garden,sky=-0.1", "garden,sky=nan",
          "garden,sky=", "garden,sky=0.1x", "garden,gaussians=20000001", "object,sky=0.1",
          "garden,sky=0.1,sky=0.1"}) {
        try {
            parse_synthetic(text);
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            const std::string words = error.what();
            EXPECT_EQ(words.find('\n'), std::string::npos) << words;
            EXPECT_EQ(words.back(), '.') << words;
        }
    }
}

} // namespace
} // namespace degs
