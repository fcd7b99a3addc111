// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/subtile_cover.hpp"

#include <gtest/gtest.h>

#include "splat/model/angles.hpp"
#include "tests/splat/frame/projected.hpp"

namespace degs {
namespace {

using test::exact_q;
using test::make_splat;
using test::random_splat;

/// Sub-tiles of the tile at (x0, y0) with a pixel inside the ellipse, one pixel at a time; only
/// pixels of the first `width` x `height`.
SubtileMask brute_mask(const ProjectedSplat& s, int x0, int y0, int side, int per_side, int width,
                       int height) {
    SubtileMask mask = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (exact_q(s, x0 + x, y0 + y) <= s.q_threshold) {
                mask |= SubtileMask{1} << (y / side * per_side + x / side);
            }
        }
    }
    return mask;
}

struct SubtileShape {
    int tile, side;
};
std::ostream& operator<<(std::ostream& out, const SubtileShape& s) {
    return out << s.tile << "px_by_" << s.side;
}
class SubtileCover : public ::testing::TestWithParam<SubtileShape> {};

// No sub-tile with a valid pixel is ever missed, and the box is never tighter than the ellipse.
TEST_P(SubtileCover, RandomSplatsAgainstBruteForce) {
    const SubtileShape shape = GetParam();
    const SubtileGrid grid(shape.tile, shape.side);
    std::mt19937 random(31);
    int skipped_by_box = 0, skipped_by_both = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const int x0 = static_cast<int>(random() % 8) * shape.tile;
        const int y0 = static_cast<int>(random() % 8) * shape.tile;
        const ProjectedSplat s = random_splat(random, x0, y0, shape.tile);
        const int width = 1 + static_cast<int>(random() % static_cast<unsigned>(shape.tile));
        const int height = trial % 2 == 0 ? shape.tile : width;
        const SubtileMask box = grid.meeting(OrientedBox(s), x0, y0);
        const SubtileMask exact = brute_mask(s, x0, y0, shape.side, grid.per_side(), width, height);
        ASSERT_EQ(exact & ~box, 0U) << "trial " << trial;
        ASSERT_EQ(exact & ~grid.holding({0, width - 1}, {0, height - 1}), 0U) << "trial " << trial;
        skipped_by_both += exact != grid.holding({0, width - 1}, {0, height - 1}) ? 1 : 0;
        skipped_by_box += box != grid.holding({0, shape.tile - 1}, {0, shape.tile - 1}) ? 1 : 0;
    }
    EXPECT_GT(skipped_by_box, 400);
    EXPECT_GT(skipped_by_both, 400);
}

INSTANTIATE_TEST_SUITE_P(Shapes, SubtileCover,
                         ::testing::Values(SubtileShape{16, 4}, SubtileShape{16, 8},
                                           SubtileShape{32, 16}, SubtileShape{64, 32},
                                           SubtileShape{16, 16}),
                         ::testing::PrintToStringParamName());

// A round splat of sigma s and Q_th = 2 ln 255: half length 3.329 s on both axes, so its box is a
// square, turned or not as the axes are.
TEST(OrientedBox, RoundSplatIsASquare) {
    const OrientedBox box(make_splat(0, 0, 3, 3, 0, 1.0)); // 9.987 px
    EXPECT_TRUE(box.meets(10, -20, 40));                   // area starts at 9.5
    EXPECT_FALSE(box.meets(11, -20, 40));                  // 10.5
    EXPECT_TRUE(box.meets(10, 10, 4)); // the corner counts, unlike with the circle
}

// Diagonal needle: half lengths 33.3 and 1.8 px. Its bounding box is 49 px wide; across the
// diagonal the box reaches 1.8 px, and a pixel's area 0.71 px more.
TEST(OrientedBox, DiagonalNeedleLeavesTheCornersFree) {
    const OrientedBox box(make_splat(100, 100, 10, std::sqrt(0.3), kPi / 4, 1.0));
    EXPECT_TRUE(box.meets(110, 110, 1));
    EXPECT_TRUE(box.meets(100, 103, 1));  // 2.12 px across
    EXPECT_FALSE(box.meets(100, 104, 1)); // 2.83 px
    EXPECT_FALSE(box.meets(110, 90, 1));
    EXPECT_FALSE(box.meets(125, 125, 1)); // 35.4 px along, 33.3 + 0.71 reached
    EXPECT_TRUE(box.meets(123, 123, 1));  // 32.5 px
    const OrientedBox other(make_splat(100, 100, 10, std::sqrt(0.3), -kPi / 4, 1.0));
    EXPECT_TRUE(other.meets(110, 90, 1));
    EXPECT_FALSE(other.meets(110, 110, 1));
}

TEST(OrientedBox, AxesOfUprightSplats) {
    const OrientedBox flat(make_splat(0, 0, 10, 1, 0, 1.0));
    EXPECT_TRUE(flat.meets(30, 0, 1));
    EXPECT_FALSE(flat.meets(0, 30, 1));
    const OrientedBox tall(make_splat(0, 0, 10, 1, kPi / 2, 1.0));
    EXPECT_FALSE(tall.meets(30, 0, 1));
    EXPECT_TRUE(tall.meets(0, 30, 1));
}

TEST(SubtileGrid, NamesTheSubtilesOfPixelsInARow) {
    const SubtileGrid four(16, 8);
    EXPECT_EQ(four.of_pixels(0, {0, 15}), 0x3U);
    EXPECT_EQ(four.of_pixels(7, {0, 7}), 0x1U);
    EXPECT_EQ(four.of_pixels(8, {7, 8}), 0xCU);
    EXPECT_EQ(four.of_pixels(15, {8, 8}), 0x8U);
    const SubtileGrid sixteen(16, 4);
    EXPECT_EQ(sixteen.of_pixels(15, {4, 11}), 0x6000U);
    EXPECT_EQ(sixteen.of_pixels(4, {15, 15}), 0x80U);
}

TEST(SubtileGrid, BitsRunByRowsAndStopAtTheImage) {
    const SubtileGrid grid(16, 8);
    EXPECT_EQ(grid.count(), 4);
    EXPECT_EQ(grid.holding({0, 15}, {0, 15}), 0xFU);
    EXPECT_EQ(grid.holding({0, 8}, {0, 7}), 0x3U);
    EXPECT_EQ(grid.holding({0, 7}, {0, 8}), 0x5U);
    EXPECT_EQ(grid.holding({0, 0}, {0, 0}), 0x1U);
    EXPECT_EQ(grid.meeting(OrientedBox(make_splat(28, 36, 0.6, 0.6, 0, 1.0)), 16, 32), 0x2U);
    EXPECT_EQ(grid.meeting(OrientedBox(make_splat(20, 44, 0.6, 0.6, 0, 1.0)), 16, 32), 0x4U);
}

} // namespace
} // namespace degs
