// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/frame_workload.hpp"

#include <numeric>

#include "degs/error.hpp"
#include "splat/frame/shared_colours.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::add_gaussian;
using test::make_camera;

std::vector<std::uint32_t> ids(const FrameWorkload& work) {
    std::vector<std::uint32_t> out;
    for (const ProjectedSplat& splat : work.splats) {
        out.push_back(splat.id);
    }
    return out;
}

class Workload : public testing::TestWithParam<TileMode> {};

TEST_P(Workload, IsConsistentWithItself) {
    const GaussianCloud cloud = test::random_cloud(2000, 11, 2);
    const FrameWorkload work = make_frame_workload(cloud, make_camera(90, 50, 60), 16, GetParam());
    EXPECT_EQ(work.tiles_x, 6);
    EXPECT_EQ(work.tiles_y, 4);
    EXPECT_EQ(work.gaussians, 2000U);
    EXPECT_EQ(work.sh_degree, 2);
    EXPECT_GT(work.culled.near, 0U);
    EXPECT_GT(work.culled.off_screen, 0U);
    EXPECT_EQ(work.splats.size() + work.culled.total(), 2000U);

    ASSERT_EQ(work.tile_begin.size(), 25U);
    EXPECT_EQ(work.tile_begin.front(), 0U);
    EXPECT_EQ(work.tile_begin.back(), work.tile_pairs());
    std::vector<std::uint32_t> touched(work.splats.size(), 0);
    for (std::size_t tile = 0; tile < 24; ++tile) {
        for (std::uint64_t i = work.tile_begin[tile]; i < work.tile_begin[tile + 1]; ++i) {
            ++touched[work.tile_splats[i]];
            if (i > work.tile_begin[tile]) {
                EXPECT_LT(work.tile_splats[i - 1], work.tile_splats[i]); // near to far, no doubles
            }
        }
    }
    EXPECT_EQ(touched, work.tiles_touched);
    EXPECT_GT(*std::min_element(touched.begin(), touched.end()), 0U);
}

TEST_P(Workload, VisibleGaussiansAreListedInCloudOrder) {
    const GaussianCloud cloud = test::random_cloud(500, 12);
    const FrameWorkload work = make_frame_workload(cloud, make_camera(90, 50, 60), 8, GetParam());
    std::vector<std::uint32_t> sorted = ids(work);
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, work.visible_of);
}

TEST_P(Workload, VisibleGaussiansAreCountedUpToAnyGaussian) {
    const FrameWorkload work =
        make_frame_workload(test::random_cloud(500, 12), make_camera(90, 50, 60), 8, GetParam());
    ASSERT_LT(work.visible_of.size(), 500U);
    std::size_t seen = 0;
    for (std::uint32_t first = 0; first <= 500; ++first) {
        ASSERT_EQ(work.visible_among(first), seen);
        seen += seen < work.visible_of.size() && work.visible_of[seen] == first ? 1 : 0;
    }
    EXPECT_EQ(seen, work.visible_of.size());
    EXPECT_EQ(work.visible_among(~std::uint64_t{0}), seen);
}

TEST_P(Workload, SplatsAreShadedAndSortedByFloatDepth) {
    const GaussianCloud cloud = test::random_cloud(500, 13, 3);
    const Camera camera = make_camera(90, 50, 60);
    const FrameWorkload work = make_frame_workload(cloud, camera, 8, GetParam());
    for (std::size_t i = 0; i < work.splats.size(); ++i) {
        const ProjectedSplat& splat = work.splats[i];
        ProjectedSplat expected;
        shade(cloud, splat.id, camera, expected);
        EXPECT_EQ(splat.colour[0], expected.colour[0]);
        EXPECT_EQ(splat.colour[2], expected.colour[2]);
        if (i > 0) {
            EXPECT_LE(static_cast<float>(work.splats[i - 1].depth),
                      static_cast<float>(splat.depth));
        }
    }
}

// H21
TEST_P(Workload, EmptyAndFullyCulledScenes) {
    const FrameWorkload empty = make_frame_workload({}, make_camera(20, 20, 20), 16, GetParam());
    EXPECT_EQ(empty.tile_pairs(), 0U);
    EXPECT_EQ(empty.tile_begin, std::vector<std::uint64_t>(5, 0));
    GaussianCloud behind;
    add_gaussian(behind, {0, 0, -5}, glm::vec3(0.1F), test::kNoTurn, 0.5F, test::kGrey);
    add_gaussian(behind, {0, 0, 5}, glm::vec3(0.1F), test::kNoTurn, 0.001F, test::kGrey);
    add_gaussian(behind, {0, 0, 5}, glm::vec3(0.1F), glm::vec4(0), 0.5F, test::kGrey);
    add_gaussian(behind, {90, 0, 5}, glm::vec3(0.1F), test::kNoTurn, 0.5F, test::kGrey);
    const FrameWorkload culled =
        make_frame_workload(behind, make_camera(20, 20, 20), 16, GetParam());
    EXPECT_TRUE(culled.splats.empty());
    EXPECT_EQ(culled.culled.near, 1U);
    EXPECT_EQ(culled.culled.transparent, 1U);
    EXPECT_EQ(culled.culled.degenerate, 1U);
    EXPECT_EQ(culled.culled.off_screen, 1U);
    EXPECT_EQ(culled.culled.explain(),
              "4 Gaussians of the scene were culled, so that their colours were not evaluated: 1 "
              "touch no pixel, 1 are nearer than the near plane, 1 are fainter than 1/255, 1 have "
              "no finite projection.");
}

INSTANTIATE_TEST_SUITE_P(Modes, Workload,
                         testing::Values(TileMode::Exact, TileMode::Square, TileMode::Box,
                                         TileMode::Tight),
                         [](const auto& mode) {
                             return tile_mode_names()[static_cast<std::size_t>(mode.param)];
                         });

// H14: ties keep index order, also when only the rounding to float makes them ties.
TEST(WorkloadOrder, EqualDepthsKeepIndexOrder) {
    const double z = 5, next_float = std::nextafter(5.0F, 6.0F);
    const double same_float = std::nextafter(5.0, 6.0);
    GaussianCloud cloud;
    for (const double depth : {next_float, same_float, z, same_float, z, 4.0, next_float}) {
        add_gaussian(cloud, {0, 0, depth}, glm::vec3(0.5F), test::kNoTurn, 0.5F, test::kGrey);
    }
    const auto work = make_frame_workload(cloud, make_camera(20, 20, 20), 16, TileMode::Exact);
    EXPECT_EQ(ids(work), (std::vector<std::uint32_t>{5, 1, 2, 3, 4, 0, 6}));
}

TEST(WorkloadOrder, ThousandsAtOneDepth) {
    GaussianCloud cloud;
    for (int i = 0; i < 5000; ++i) {
        add_gaussian(cloud, {0, 0, 5}, glm::vec3(0.5F), test::kNoTurn, 0.5F, test::kGrey);
    }
    const auto work = make_frame_workload(cloud, make_camera(20, 20, 20), 16, TileMode::Exact);
    std::vector<std::uint32_t> expected(5000);
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_EQ(ids(work), expected);
}

// H15: an integer depth key would merge the near field.
TEST(WorkloadOrder, DepthRangeOfEightDecades) {
    GaussianCloud cloud;
    for (const double depth : {1e7, 0.2001, 9.99e6, 0.20011, 3.0}) {
        add_gaussian(cloud, {0, 0, depth}, glm::vec3(0.1F * static_cast<float>(depth)),
                     test::kNoTurn, 0.5F, test::kGrey);
    }
    const auto work = make_frame_workload(cloud, make_camera(20, 20, 20), 16, TileMode::Exact);
    EXPECT_EQ(ids(work), (std::vector<std::uint32_t>{1, 3, 4, 2, 0}));
}

TEST(WorkloadModes, VisibilityFollowsTheTilesOfTheMode) {
    const Camera camera = make_camera(32, 32, 100);
    GaussianCloud cloud; // sigma 4.04 px, 3-sigma radius 13 px, left of the image
    // At -10 with reach 1.8 sigma: only the square touches the image.
    add_gaussian(cloud, {-25.5 * 0.05, 0, 5}, glm::vec3(0.2F), test::kNoTurn, 0.02F, test::kGrey);
    // At -12.5 with reach 3.33 sigma: only the ellipse does; the square ends one pixel short.
    add_gaussian(cloud, {-28 * 0.05, 0, 5}, glm::vec3(0.2F), test::kNoTurn, 1.0F, test::kGrey);
    const auto exact = make_frame_workload(cloud, camera, 16, TileMode::Exact);
    EXPECT_EQ(ids(exact), std::vector<std::uint32_t>{1});
    const auto square = make_frame_workload(cloud, camera, 16, TileMode::Square);
    EXPECT_EQ(ids(square), std::vector<std::uint32_t>{0});
}

TEST(WorkloadModes, ASplatBetweenPixelCentresIsNotVisible) {
    GaussianCloud cloud; // a bounding box holds pixels, the thin faint ellipse none
    const auto turn = test::turn_about_z(test::kPi / 4);
    add_gaussian(cloud, {0.025, 0, 5}, glm::vec3(0.2F, 0, 0), turn, 1.1F / 255, test::kGrey);
    ProjectedSplat splat;
    const Camera camera = make_camera(32, 32, 100);
    ASSERT_EQ(project(cloud, 0, camera, {}, splat), Cull::None);
    const auto work = make_frame_workload(cloud, camera, 16, TileMode::Exact);
    EXPECT_TRUE(work.splats.empty());
    EXPECT_EQ(work.culled.off_screen, 1U);
}

TEST(WorkloadErrors, ImpossibleArgumentsAreNamed) {
    const auto make = [](int width, int tile_size, double near_plane) {
        ProjectionOptions options;
        options.near_plane = near_plane;
        make_frame_workload({}, make_camera(width, 10, 10), tile_size, TileMode::Exact, options);
    };
    EXPECT_NO_THROW(make(1, 1, 0));
    EXPECT_THROW(make(0, 16, 0.2), InputError);
    EXPECT_THROW(make(10, 0, 0.2), InputError);
    EXPECT_THROW(make(10, 1 << 20, 0.2), InputError);
    EXPECT_THROW(make(10, 16, -1), InputError);
    EXPECT_THROW(make(10, 16, std::nan("")), InputError);
    EXPECT_THROW(make_frame_workload({}, make_camera(10, 10, 0), 16, TileMode::Exact), InputError);
}

// Two means nearer than the near plane; one of them is beside the image.
TEST(CullCounts, NearGaussiansInViewAreThoseInTheImage) {
    GaussianCloud cloud;
    for (const double x : {0.0, 0.09, 0.01}) {
        add_gaussian(cloud, {x, 0, x == 0.01 ? 2 : 0.1}, glm::vec3(0.02F), {1, 0, 0, 0}, 0.5F,
                     glm::vec3(1));
    }
    const FrameWorkload work =
        make_frame_workload(cloud, make_camera(64, 64, 64), 16, TileMode::Exact);
    EXPECT_EQ(work.culled.near, 2U);
    EXPECT_EQ(work.culled.near_in_view, 1U);
}

// The colours of views that lie beside each other are seen from the place that they share.
TEST(SharedColours, AreThoseOfTheGivenPlace) {
    const GaussianCloud cloud = test::random_cloud(200, 12, 2);
    Camera camera = make_camera(64, 48, 60);
    FrameWorkload frame = make_frame_workload(cloud, camera, 16, TileMode::Exact);
    camera.position = {0.4, 0.1, -0.2};
    const FrameWorkload moved = make_frame_workload(cloud, camera, 16, TileMode::Exact);
    shade_from(cloud, camera.position, frame);
    int both = 0;
    for (const ProjectedSplat& splat : frame.splats) {
        for (const ProjectedSplat& other : moved.splats) {
            if (splat.id == other.id) {
                ++both;
                EXPECT_EQ(splat.colour[0], other.colour[0]) << splat.id;
            }
        }
    }
    EXPECT_GT(both, 50);
}

} // namespace
} // namespace degs
