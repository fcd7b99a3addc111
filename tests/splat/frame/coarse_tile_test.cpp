// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/coarse_tile.hpp"

#include <cmath>

#include "splat/reference/reference_renderer.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::add_gaussian;
using test::make_camera;

FrameWorkload coarse_crowd() {
    GaussianCloud cloud;
    for (int i = 0; i < 900; ++i) {
        const auto a = static_cast<float>(i);
        add_gaussian(cloud, {std::sin(a) * 1.2F, std::cos(1.7F * a) * 0.9F, 4 + 0.01F * a},
                     glm::vec3(0.1F + 0.2F * std::abs(std::sin(3 * a)), 0.2F, 0.1F), test::kNoTurn,
                     0.6F + 0.35F * std::abs(std::cos(a)), {0.5F, 1, 2});
    }
    return make_frame_workload(cloud, make_camera(150, 100, 110), 32, TileMode::Exact);
}

struct CoarseCounts {
    double rows = 0, tasks = 0, fragments = 0, walked = 0;
};

CoarseCounts count(const FrameWorkload& frame, const CoarseTile::Options& options,
                   const RowChoice& choice) {
    CoarseCounts counts;
    CoarseTile tile(frame, options);
    for (int t = 0; t < frame.tiles(); ++t) {
        tile.begin(t, choice);
        while (tile.next()) {
            for (const CoarseSpan& span : tile.spans()) {
                counts.rows += tile.row_weight();
                counts.tasks += tile.row_weight() * span.length();
                EXPECT_GE(span.first, 0);
                EXPECT_LT(span.last, tile.columns().size());
                EXPECT_GE(span.row, tile.first_row());
                EXPECT_LE(span.row, tile.last_row());
            }
            tile.blend();
        }
        counts.fragments += tile.fragments();
        counts.walked += tile.walked();
    }
    return counts;
}

TEST(CoarseTile, ComesCloseToTheFragmentsOfTheReference) {
    const FrameWorkload frame = coarse_crowd();
    ReferenceCounts reference;
    render_reference(frame, reference);
    const CoarseCounts all = count(frame, {16, 1}, {});
    const auto fragments = static_cast<double>(reference.fragments);
    EXPECT_NEAR(all.fragments, fragments, 0.03 * fragments);
    EXPECT_LE(all.fragments, all.tasks);
}

TEST(CoarseTile, StandsForTheRowsThatItLeavesOut) {
    const FrameWorkload frame = coarse_crowd();
    const CoarseCounts all = count(frame, {16, 1}, {});
    const CoarseCounts some = count(frame, {16, 1}, {1, 4, 1});
    const CoarseCounts blocks = count(frame, {8, 8}, {8, 2, 1});
    EXPECT_NEAR(some.rows, all.rows, 0.1 * all.rows);
    EXPECT_NEAR(some.fragments, all.fragments, 0.1 * all.fragments);
    EXPECT_NEAR(blocks.fragments, all.fragments, 0.15 * all.fragments);
}

TEST(CoarseTile, OutwardSpansAreAPixelWiderOnAverage) {
    const FrameWorkload frame = coarse_crowd();
    const CoarseCounts inside = count(frame, {16, 1}, {});
    const CoarseCounts outward = count(frame, {16, 1, true, 0}, {});
    const CoarseCounts wider = count(frame, {16, 1, true, 2}, {});
    const double more = (outward.tasks - inside.tasks) / inside.rows;
    EXPECT_GT(more, 0.7);
    EXPECT_LT(more, 2.2); // rows without a pixel inside get some
    EXPECT_GT(wider.tasks, outward.tasks + 2 * inside.rows);
    EXPECT_NEAR(outward.fragments, inside.fragments, 1e-9 * inside.fragments);
}

/// Splats of the list of tile 0 until the pixel ends.
double end_of_pixel(const FrameWorkload& frame, int x, int y) {
    double transmittance = 1;
    for (std::uint64_t entry = 0; entry < frame.tile_begin[1]; ++entry) {
        const ProjectedSplat& splat = frame.splats[frame.tile_splats[entry]];
        const double dx = x - splat.mu_x, dy = y - splat.mu_y;
        const double q =
            (splat.cov_c * dx * dx - 2 * splat.cov_b * dx * dy + splat.cov_a * dy * dy) / splat.det;
        transmittance *= 1 - splat.opacity * std::exp(-q / 2);
        if (transmittance < 1e-4) {
            return static_cast<double>(entry + 1);
        }
    }
    return static_cast<double>(frame.tile_begin[1]);
}

// Pixels end later from left to right, and columns 0, 4, 8 and 12 are sampled: 12 px apart from
// each other, and 3 px from the last pixel, half of which is expected because all phases are alike.
TEST(CoarseTile, ExpectsPixelsThatAreNotSampledToEndLater) {
    GaussianCloud cloud;
    for (int i = 0; i < 300; ++i) {
        add_gaussian(cloud, {-2, 0, 4 + 1e-4F * static_cast<float>(i)}, glm::vec3(3), test::kNoTurn,
                     0.3F, {1, 1, 1});
    }
    const FrameWorkload frame =
        make_frame_workload(cloud, make_camera(16, 1, 16), 16, TileMode::Exact);
    CoarseTile tile(frame, {16, 1});
    tile.begin(0, {});
    while (tile.next()) {
        EXPECT_TRUE(tile.cell_is_live(0, 0)) << tile.walked();
        tile.blend();
    }
    const double first = end_of_pixel(frame, 0, 0), last = end_of_pixel(frame, 12, 0);
    EXPECT_NEAR(tile.walked(), last + (last - first) * 1.5 / 12, 1);
    EXPECT_GT(tile.walked(), last);
    EXPECT_LE(tile.walked(), end_of_pixel(frame, 15, 0));
}

TEST(CoarseTile, SamplesARowOfAnyTileAndPixelsOfAnyWidth) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(1), test::kNoTurn, 0.9F, {1, 1, 1});
    const FrameWorkload frame =
        make_frame_workload(cloud, make_camera(33, 33, 40), 32, TileMode::Exact);
    CoarseTile tile(frame, {16, 1});
    tile.begin(3, {1, 16, 15}); // one pixel wide and high
    EXPECT_EQ(tile.rows().size(), 1U);
    EXPECT_EQ(tile.columns().size(), 1);
    ASSERT_TRUE(tile.next());
    ASSERT_EQ(tile.spans().size(), 1U);
    EXPECT_EQ(tile.live_share(tile.spans().front()), 1);
    tile.blend();
    EXPECT_FALSE(tile.next());
    EXPECT_EQ(tile.walked(), 1);
}

TEST(CoarseTile, EndsWithItsLastPixel) {
    GaussianCloud cloud;
    for (int i = 0; i < 50; ++i) {
        add_gaussian(cloud, {0, 0, 4 + 0.1F * static_cast<float>(i)}, glm::vec3(20), test::kNoTurn,
                     0.99F, {1, 1, 1});
    }
    const FrameWorkload frame =
        make_frame_workload(cloud, make_camera(32, 32, 20), 32, TileMode::Exact);
    CoarseTile tile(frame, {16, 1});
    tile.begin(0, {});
    while (tile.next()) {
        tile.blend();
    }
    EXPECT_LT(tile.walked(), 6); // 0.01^3 is below the threshold of 1e-4
    EXPECT_FALSE(tile.cell_is_live(0, 0));
    EXPECT_EQ(tile.live_share({5, 3, 9}), 0);
}

} // namespace
} // namespace degs
