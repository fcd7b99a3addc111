// SPDX-License-Identifier: Apache-2.0
#include "splat/pixel_rows.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

TEST(PixelRows, RowsAreAsLongAsBlocksOfLanes) {
    EXPECT_EQ(PixelRows(1, 4).stride(), 32U);
    EXPECT_EQ(PixelRows(1, 32).stride(), 32U);
    EXPECT_EQ(PixelRows(1, 33).stride(), 64U);
}

TEST(PixelRows, HaveNoPixelsUntilTheyAreUsed) {
    PixelRows rows(32767, 128);
    EXPECT_FALSE(rows.placed(32766, 127));
    EXPECT_EQ(rows.place(32766, 127), 0U);
    EXPECT_TRUE(rows.placed(32766, 127));
    EXPECT_EQ(rows.place(0, 5), 128U);
    EXPECT_EQ(rows.first_pixel(32766, 127), 0U);
    EXPECT_FALSE(rows.placed(0, 4));
}

TEST(PixelRows, PixelsAreUsedAgain) {
    PixelRows rows(2, 16);
    rows.place(0, 0);
    rows.place(0, 1);
    rows.release(0, 0);
    rows.release(0, 0); // a row without pixels has none to give back
    EXPECT_FALSE(rows.placed(0, 0));
    EXPECT_EQ(rows.place(1, 7), 0U);
    EXPECT_EQ(rows.place(1, 8), 64U);
}

} // namespace
} // namespace degs
