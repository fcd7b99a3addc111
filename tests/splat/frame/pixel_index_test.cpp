// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/pixel_index.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

TEST(PixelRange, HasBothItsEnds) {
    const PixelRange range{3, 5};
    EXPECT_FALSE(range.empty());
    EXPECT_EQ(range.size(), 3);
    EXPECT_FALSE(range.holds(2));
    EXPECT_TRUE(range.holds(3));
    EXPECT_TRUE(range.holds(5));
    EXPECT_FALSE(range.holds(6));
}

TEST(PixelRange, IsEmptyUnlessItsEndsAreGiven) {
    EXPECT_TRUE(PixelRange{}.empty());
    EXPECT_EQ(PixelRange{}.size(), 0);
    EXPECT_FALSE(PixelRange{}.holds(0));
}

TEST(PixelRange, BoundsCutItOffOrLeaveNothing) {
    const PixelRange part = PixelRange{-4, 9}.within({0, 7});
    EXPECT_EQ(part.first, 0);
    EXPECT_EQ(part.last, 7);
    const PixelRange outside = PixelRange{12, 20}.within({0, 7});
    EXPECT_TRUE(outside.empty());
    EXPECT_EQ(outside.size(), 0);
}

TEST(PixelRange, IsWidenedAndMoved) {
    const PixelRange range = PixelRange{10, 12}.widened(2).relative_to(8);
    EXPECT_EQ(range.first, 0);
    EXPECT_EQ(range.last, 6);
}

} // namespace
} // namespace degs
