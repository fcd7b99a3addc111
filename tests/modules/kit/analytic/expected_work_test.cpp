// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/expected_work.hpp"

#include <cmath>

#include "modules/degs/config.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

FrameWorkload expected_crowd(float shift) {
    GaussianCloud cloud;
    for (int i = 0; i < 900; ++i) {
        const auto a = static_cast<float>(i);
        test::add_gaussian(cloud,
                           {shift + std::sin(a) * 1.2F, std::cos(1.7F * a) * 0.9F, 4 + 0.01F * a},
                           glm::vec3(0.1F + 0.2F * std::abs(std::sin(3 * a)), 0.2F, 0.1F),
                           test::kNoTurn, 0.6F + 0.35F * std::abs(std::cos(a)), {0.5F, 1, 2});
    }
    return make_frame_workload(cloud, test::make_camera(150, 100, 110), 32, TileMode::Exact);
}

TileWork sum_of_work(const std::vector<TileWork>& tiles) {
    TileWork sum = kNoWork;
    for (const TileWork& tile : tiles) {
        sum += tile;
    }
    return sum;
}

TEST(ExpectedWork, ComesCloseToTheReference) {
    const FrameWorkload frame = expected_crowd(0);
    ReferenceCounts counts;
    render_reference(frame, counts);
    ASSERT_GT(counts.terminated, 100U);
    const TileWork all = sum_of_work(expected_work(frame, nullptr));
    const auto fragments = static_cast<double>(counts.fragments);
    EXPECT_NEAR(all.fragments, fragments, 0.03 * fragments);
    EXPECT_EQ(all.entries, static_cast<double>(frame.tile_pairs()));
    EXPECT_LE(all.walked, all.entries);
    EXPECT_GT(all.tasks, all.fragments);
    EXPECT_GT(all.rows, all.walked);
    EXPECT_EQ(all.cycles, 0);
}

TEST(ExpectedWork, HasTheTilesThatListASplatInOrder) {
    const FrameWorkload frame = expected_crowd(1.8F); // the left of the image is empty
    const std::vector<TileWork> tiles = expected_work(frame, nullptr);
    std::vector<double> entries;
    for (int t = 0; t < frame.tiles(); ++t) {
        if (frame.tile_begin[t] != frame.tile_begin[t + 1]) {
            entries.push_back(static_cast<double>(frame.tile_begin[t + 1] - frame.tile_begin[t]));
        }
    }
    ASSERT_LT(tiles.size(), static_cast<std::size_t>(frame.tiles()));
    ASSERT_EQ(tiles.size(), entries.size());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        EXPECT_EQ(tiles[t].entries, entries[t]);
    }
}

// With one task per PE and cycle at best, no tile is faster than its fragments.
TEST(ExpectedWork, FollowsTheClockOfADesign) {
    const FrameWorkload frame = expected_crowd(0);
    const DegsConfig config;
    const TileWork all = sum_of_work(expected_work(frame, config.analytic().get()));
    EXPECT_GT(all.cycles, all.fragments / config.pes());
    EXPECT_LT(all.cycles, 20 * all.fragments / config.pes());
}

} // namespace
} // namespace degs
