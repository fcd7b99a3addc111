// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/pixel_rows.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

TEST(PixelRows, RowsAreAsLongAsBlocksOfLanes) {
    EXPECT_EQ(PixelRows(1, 4).stride(), 32U);
    EXPECT_EQ(PixelRows(1, 32).stride(), 32U);
    EXPECT_EQ(PixelRows(1, 33).stride(), 64U);
}

/// Remembers what was cleared last.
struct ClearedPixels {
    std::size_t first = 0, count = 0;
    int calls = 0;
    void clear(std::size_t begin, std::size_t size) {
        first = begin;
        count = size;
        ++calls;
    }
};

TEST(PixelRows, HaveNoPixelsUntilTheyAreUsed) {
    PixelRows rows(32767, 128);
    ClearedPixels planes;
    EXPECT_FALSE(rows.placed(32766, 127));
    EXPECT_EQ(rows.ready(32766, 127, planes), 0U);
    EXPECT_TRUE(rows.placed(32766, 127));
    EXPECT_EQ(rows.ready(0, 5, planes), 128U);
    EXPECT_EQ(rows.first_pixel(32766, 127), 0U);
    EXPECT_EQ(rows.first_pixel(0, 5), 128U);
    EXPECT_FALSE(rows.placed(0, 4));
}

TEST(PixelRows, PixelsAreClearedOncePerUse) {
    PixelRows rows(2, 33);
    ClearedPixels planes;
    rows.ready(0, 0, planes);
    rows.ready(1, 32, planes);
    EXPECT_EQ(planes.first, 64U);
    EXPECT_EQ(planes.count, 64U);
    EXPECT_EQ(rows.ready(1, 32, planes), 64U);
    EXPECT_EQ(planes.calls, 2);
    rows.release(1, 32);
    EXPECT_EQ(rows.ready(1, 32, planes), 64U);
    EXPECT_EQ(planes.calls, 3);
}

TEST(PixelRows, PixelsAreUsedAgain) {
    PixelRows rows(2, 16);
    ClearedPixels planes;
    rows.ready(0, 0, planes);
    rows.ready(0, 1, planes);
    rows.release(0, 0);
    rows.release(0, 0); // a row without pixels has none to give back
    EXPECT_FALSE(rows.placed(0, 0));
    EXPECT_EQ(rows.ready(1, 7, planes), 0U);
    EXPECT_EQ(rows.ready(1, 8, planes), 64U);
}

} // namespace
} // namespace degs
