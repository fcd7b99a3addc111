// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/tile_work.hpp"

#include "splat/reference_renderer.hpp"
#include "tests/splat/brute_force.hpp"

namespace degs {
namespace {

using test::add_gaussian;
using test::make_camera;

/// A cloud of overlapping splats, opaque enough to end pixels.
FrameWorkload crowd() {
    GaussianCloud cloud;
    for (int i = 0; i < 900; ++i) {
        const auto a = static_cast<float>(i);
        add_gaussian(cloud, {std::sin(a) * 1.2F, std::cos(1.7F * a) * 0.9F, 4 + 0.01F * a},
                     glm::vec3(0.1F + 0.2F * std::abs(std::sin(3 * a)), 0.2F, 0.1F), test::kNoTurn,
                     0.6F + 0.35F * std::abs(std::cos(a)), {0.5F, 1, 2});
    }
    return make_frame_workload(cloud, make_camera(150, 100, 110), 32, TileMode::Exact);
}

TEST(TileWork, CountsTheFragmentsOfTheReferenceIfAllRowsAreRendered) {
    const FrameWorkload frame = crowd();
    ReferenceCounts counts;
    render_reference(frame, counts);
    ASSERT_GT(counts.terminated, 100U);
    TileWork all = kNoWork;
    for (const TileWork& tile : estimate_tile_work(frame, 1)) {
        all += tile;
    }
    const auto fragments = static_cast<double>(counts.fragments);
    EXPECT_NEAR(all.fragments, fragments, 1e-3 * fragments);
    EXPECT_EQ(all.pixels, 150 * 100);
    EXPECT_EQ(all.tiles, frame.tiles());
    EXPECT_EQ(all.entries, static_cast<double>(frame.tile_pairs()));
    EXPECT_LE(all.walked, all.entries);
    EXPECT_GT(all.tasks, all.fragments);
}

TEST(TileWork, IsCloseFromAFewRows) {
    const FrameWorkload frame = crowd();
    TileWork all = kNoWork, some = kNoWork;
    const std::vector<TileWork> exact = estimate_tile_work(frame, 1);
    const std::vector<TileWork> sampled = estimate_tile_work(frame, 4);
    for (std::size_t t = 0; t < exact.size(); ++t) {
        all += exact[t];
        some += sampled[t];
        EXPECT_EQ(sampled[t].entries, exact[t].entries);
    }
    EXPECT_NEAR(some.fragments, all.fragments, 0.05 * all.fragments);
    EXPECT_NEAR(some.rows, all.rows, 0.05 * all.rows);
    EXPECT_LE(some.walked, all.walked);
}

TEST(TileWork, OfOneSplatIsItsRowsAndPixels) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(0.1F), test::kNoTurn, 0.5F, {1, 1, 1});
    const FrameWorkload frame =
        make_frame_workload(cloud, make_camera(64, 64, 100), 64, TileMode::Exact);
    ReferenceCounts counts;
    const Image image = render_reference(frame, counts);
    double rows = 0;
    for (int y = 0; y < 64; ++y) {
        bool any = false;
        for (int x = 0; x < 64; ++x) {
            any = any || image.fragments[image.at(x, y)] != 0;
        }
        rows += any ? 1 : 0;
    }
    const TileWork tile = estimate_tile_work(frame, 1).at(0);
    EXPECT_EQ(tile.rows, rows);
    EXPECT_EQ(tile.fragments, static_cast<double>(counts.fragments));
    EXPECT_EQ(tile.tasks, tile.fragments);
    EXPECT_EQ(tile.walked, 1);
}

TEST(TileWork, OfATileThatListsNothingIsItsPixels) {
    GaussianCloud cloud;
    const FrameWorkload frame =
        make_frame_workload(cloud, make_camera(40, 20, 50), 32, TileMode::Exact);
    const std::vector<TileWork> tiles = estimate_tile_work(frame);
    ASSERT_EQ(tiles.size(), 2U);
    EXPECT_EQ(tiles[1].pixels, 8 * 20);
    EXPECT_EQ(tiles[1].fragments, 0);
    EXPECT_EQ(tiles[1].entries, 0);
}

} // namespace
} // namespace degs
