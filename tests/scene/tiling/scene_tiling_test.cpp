// SPDX-License-Identifier: Apache-2.0
#include "scene/tiling/scene_tiling.hpp"

#include "scene/scene.hpp"
#include "splat/frame/frame_workload.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

TEST(SceneTiling, ReadsItsCounts) {
    const TilingCounts flat = parse_tiling("4x3");
    EXPECT_EQ(flat.x, 4);
    EXPECT_EQ(flat.z, 3);
    EXPECT_EQ(flat.y, 1);
    EXPECT_EQ(flat.copies, 12U);
    const TilingCounts layers = parse_tiling("4x3x2");
    EXPECT_EQ(layers.y, 2);
    EXPECT_EQ(layers.copies, 24U);
}

TEST(HostileSceneTiling, SaysHowCountsAreWritten) {
    for (const char* const text : {"", "4", "x", "4x", "x3", "0x3", "4x-1", "4x3x2x1", "4.5x2",
                                   "4 x 3", "999999x1", "axb"}) {
        EXPECT_THAT(test::complaint([&] { parse_tiling(text); }),
                    test::IsSentenceWith("are not written as in 4x3"))
            << text;
    }
    EXPECT_THAT(test::complaint([] { parse_tiling("99999x99999x99999"); }),
                test::IsSentenceWith("16384 copies"));
    EXPECT_THAT(test::complaint([] { tiling_for(UINT64_MAX, 1); }),
                test::IsSentenceWith("16384 copies"));
}

TEST(SceneTiling, TakesTheFewestCopies) {
    EXPECT_EQ(tiling_for(1, 1000).copies, 1U);
    EXPECT_EQ(tiling_for(1000, 1000).copies, 1U);
    const TilingCounts counts = tiling_for(6001, 1000);
    EXPECT_EQ(counts.copies, 7U);
    EXPECT_EQ(counts.x, 3);
    EXPECT_EQ(counts.z, 3);
}

class TiledScene : public testing::TestWithParam<const char*> {};

/// Written, read again and seen: every copy has its place, and the views see what they promise.
TEST_P(TiledScene, ShowsItsCopies) {
    DEGS_NEEDS_SCENE(GetParam());
    const Scene scene = load_scene((test::scenes() / GetParam() / "scene.ply").string());
    const TilingCounts counts = tiling_for(6 * scene.cloud.size(), scene.cloud.size());
    const SceneTiling tiling = tile_scene(scene.cloud, counts);
    ASSERT_EQ(tiling.instances.size(), 6U);
    const test::Folder folder;
    const std::string path = folder.path("tiled.glb");
    write_glb(scene.cloud, tiling.cameras, tiling.instances, path);
    const Scene tiled = load_scene(path);
    ASSERT_EQ(tiled.cloud.size(), 6 * scene.cloud.size());
    ASSERT_EQ(tiled.cameras.size(), 3U);

    // The mean of each copy: neighbours are one spacing apart, up to what turning moves it.
    const auto mean_of = [&](std::size_t copy) {
        glm::dvec3 sum(0.0);
        const std::size_t first = copy * scene.cloud.size();
        for (std::size_t i = first; i < first + scene.cloud.size(); ++i) {
            sum += tiled.cloud.means[i];
        }
        return sum / static_cast<double>(scene.cloud.size());
    };
    const double step = tiling.spacing.x;
    EXPECT_NEAR(mean_of(1).x - mean_of(0).x, step, 0.5 * step);
    EXPECT_NEAR(mean_of(3).z - mean_of(0).z, step, 0.5 * step);
    EXPECT_NEAR(mean_of(1).y - mean_of(0).y, 0, 1e-9 * step);

    const FrameWorkload overview = make_frame_workload(
        tiled.cloud, tiled.cameras[0].scaled_to_width(640), 16, TileMode::Exact);
    EXPECT_GT(overview.splats.size() + overview.culled.transparent, 95 * tiled.cloud.size() / 100);
    for (int camera = 1; camera < 3; ++camera) {
        const FrameWorkload view = make_frame_workload(
            tiled.cloud, tiled.cameras[camera].scaled_to_width(640), 16, TileMode::Exact);
        EXPECT_GT(view.splats.size() + view.culled.transparent,
                  (camera == 1 ? 40 : 25) * tiled.cloud.size() / 100)
            << camera;
    }
}
INSTANTIATE_TEST_SUITE_P(Shared, TiledScene,
                         testing::Values("skull", "flowers-small", "fruit-drops"),
                         [](const auto& row) {
                             std::string name = row.param;
                             name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                             return name;
                         });

TEST(SceneTiling, WorksForOneGaussian) {
    GaussianCloud cloud;
    cloud.means = {{1, 2, 3}};
    cloud.scales = {{1, 1, 1}};
    cloud.rotations = {{1, 0, 0, 0}};
    cloud.opacities = {1};
    cloud.sh = {0, 0, 0};
    const SceneTiling tiling = tile_scene(cloud, parse_tiling("2x2x2"));
    EXPECT_EQ(tiling.spacing, glm::dvec3(1));
    EXPECT_EQ(tiling.instances.size(), 8U);
}

} // namespace
} // namespace degs
