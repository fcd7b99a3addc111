// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sim/view.hpp"
#include "splat/error.hpp"

namespace degs::sim {
namespace {

Camera full_hd() {
    Camera camera;
    camera.width = 1920;
    camera.height = 1080;
    camera.fx = 1500;
    camera.fy = 1510;
    return camera;
}

TEST(Resize, KeepsTheViewWithoutOptions) {
    const Camera same = resize(full_hd(), {}, {});
    EXPECT_EQ(same.width, 1920);
    EXPECT_EQ(same.height, 1080);
    EXPECT_EQ(same.fx, 1500);
}

TEST(Resize, OneSideScalesBoth) {
    for (const Camera& half : {resize(full_hd(), 960, {}), resize(full_hd(), {}, 540)}) {
        EXPECT_EQ(half.width, 960);
        EXPECT_EQ(half.height, 540);
        EXPECT_DOUBLE_EQ(half.fx, 750);
        EXPECT_DOUBLE_EQ(half.fy, 755);
    }
}

TEST(Resize, BothSidesCropAtTheScaleOfTheWidth) {
    const Camera square = resize(full_hd(), 960, 960);
    EXPECT_EQ(square.width, 960);
    EXPECT_EQ(square.height, 960);
    EXPECT_DOUBLE_EQ(square.fx, 750);
    EXPECT_DOUBLE_EQ(square.fy, 755);
}

TEST(Resize, LimitsThePixels) {
    EXPECT_EQ(resize(full_hd(), 7680, {}).height, 4320); // just allowed
    EXPECT_THROW(resize(full_hd(), 7682, {}), InputError);
    EXPECT_THROW(resize(full_hd(), 1, 40000000), InputError);
    EXPECT_THROW(resize(full_hd(), 0, {}), InputError);
    EXPECT_THROW(resize(full_hd(), {}, -1), InputError);
    Camera huge = full_hd();
    huge.width = huge.height = 60000; // a camera file may ask for too much, too
    EXPECT_THROW(resize(huge, {}, {}), InputError);
}

} // namespace
} // namespace degs::sim
