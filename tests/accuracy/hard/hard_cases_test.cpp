// SPDX-License-Identifier: Apache-2.0
// What the hard cases are made of, by formulas of their own.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "accuracy/hard/hard_builder.hpp"

namespace degs {
namespace {

TEST(HardCases, AreNumberedAndComplete) {
    ASSERT_EQ(hard_cases().size(), 32U);
    for (std::size_t i = 0; i < hard_cases().size(); ++i) {
        const HardCase& hard = hard_cases()[i];
        EXPECT_EQ(hard.id, "H" + std::to_string(i + 1));
        EXPECT_FALSE(hard.what.empty());
        EXPECT_TRUE(hard.make != nullptr || hard.refuse != nullptr) << hard.id;
        EXPECT_FALSE(hard.expectation.empty()) << hard.id;
    }
}

TEST(HardCases, SameScenesAgainAndWindowsInTheImage) {
    for (const HardCase& hard : hard_cases()) {
        if (hard.make == nullptr || hard.id == "H17") { // a million
            continue;
        }
        const std::vector<HardScene> scenes = hard.make(1920, 1080);
        const std::vector<HardScene> again = hard.make(1920, 1080);
        ASSERT_EQ(scenes.size(), again.size());
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            EXPECT_EQ(scenes[i].cloud.sh.size(), again[i].cloud.sh.size());
            EXPECT_EQ(scenes[i].cloud.opacities.size(), again[i].cloud.size());
            ASSERT_FALSE(scenes[i].windows.empty()) << hard.id;
            for (const PixelBox& box : scenes[i].windows) {
                EXPECT_FALSE(box.empty()) << hard.id;
                EXPECT_GE(std::min(box.x0, box.y0), 0) << hard.id;
                EXPECT_LT(box.x1, scenes[i].camera.width) << hard.id;
                EXPECT_LT(box.y1, scenes[i].camera.height) << hard.id;
            }
        }
    }
}

// The builder's places are those of the projection.
TEST(HardCases, SplatsAreWhereTheyAreSaidToBe) {
    HardBuilder builder(641, 480);
    builder.add({100.25, 333.5, 12, 5, 0.7, 0.6, {0.2, 0.4, 0.9}, 3});
    const FrameWorkload work =
        make_frame_workload(builder.scene.cloud, builder.scene.camera, 16, TileMode::Exact);
    ASSERT_EQ(work.splats.size(), 1U);
    const ProjectedSplat& splat = work.splats[0];
    EXPECT_NEAR(splat.mu_x, 100.25, 1e-9);
    EXPECT_NEAR(splat.mu_y, 333.5, 1e-9);
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    EXPECT_NEAR(splat.cov_a, 144 * c * c + 25 * s * s + 0.3, 1e-3);
    EXPECT_NEAR(splat.cov_b, (144 - 25) * c * s, 1e-3);
    EXPECT_NEAR(splat.cov_c, 144 * s * s + 25 * c * c + 0.3, 1e-3);
    EXPECT_NEAR(splat.colour[2], 0.9, 1e-6);
    EXPECT_NEAR(splat.opacity, 0.6, 1e-7);
}

// Under the sanitizers, too.
TEST(HostileHardCases, BrokenFilesAreRefused) {
    const auto folder = std::filesystem::temp_directory_path() / "degs-broken-files";
    std::filesystem::create_directories(folder);
    for (const auto refuse : {refuse_broken_files, refuse_node_transforms, refuse_broken_glb}) {
        EXPECT_EQ(refuse(folder.string()), "");
        EXPECT_TRUE(std::filesystem::is_empty(folder)); // removed again
    }
    std::filesystem::remove(folder);
}

FrameWorkload frame_of(const HardScene& scene, const ProjectionOptions& options) {
    return make_frame_workload(scene.cloud, scene.camera, 32, TileMode::Exact, options);
}

// What the checks of rules and files complain about when a rule is not followed.
TEST(HardCases, ChecksNoticeWhatIsWrong) {
    for (const HardScene& scene : make_order_case(640, 360)) {
        ProjectionOptions other = scene.projection;
        other.order = other.order == SplatOrder::Depth ? SplatOrder::Distance : SplatOrder::Depth;
        EXPECT_EQ(check_order_case(scene, frame_of(scene, scene.projection)), "");
        EXPECT_NE(check_order_case(scene, frame_of(scene, other)), "");
    }
    const std::vector<HardScene> files = make_antialiased_case(640, 360);
    ASSERT_EQ(files.size(), 2U);
    EXPECT_FALSE(files[0].projection.compensated);
    EXPECT_TRUE(files[1].projection.compensated); // as the file says
    EXPECT_EQ(check_antialiased(files[1], frame_of(files[1], files[1].projection)), "");
    EXPECT_NE(check_antialiased(files[1], frame_of(files[1], files[0].projection)), "");
    HardScene coarse = make_quantised_case(640, 360).front();
    EXPECT_EQ(sanitize(coarse.cloud).total(), 0U);
    const FrameWorkload frame = frame_of(coarse, coarse.projection);
    EXPECT_EQ(check_quantised(coarse, frame), "");
    coarse.cloud.means[7].x += 0.001; // four steps
    EXPECT_NE(check_quantised(coarse, frame), "");
}

} // namespace
} // namespace degs
