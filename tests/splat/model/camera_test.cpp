// SPDX-License-Identifier: Apache-2.0
#include "splat/model/camera.hpp"

#include "degs/error.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

TEST(CameraScaling, KeepsTheFieldOfViewAndRoundsTheHeight) {
    Camera camera = test::make_camera(640, 427, 500);
    camera.fy = 510;
    camera.name = "view";
    const Camera scaled = camera.scaled_to_width(1280);
    EXPECT_EQ(scaled.width, 1280);
    EXPECT_EQ(scaled.height, 854);
    EXPECT_EQ(scaled.fx, 1000);
    EXPECT_EQ(scaled.fy, 1020);
    EXPECT_EQ(scaled.name, "view");
    EXPECT_EQ(camera.scaled_to_width(320).height, 214); // 213.5
    EXPECT_EQ(camera.scaled_to_width(1).height, 1);     // never 0
    EXPECT_EQ(camera.scaled_to_width(640).fx, 500);
}

TEST(CameraScaling, RefusesImpossibleSizes) {
    const Camera camera = test::make_camera(100, 300, 100);
    EXPECT_THROW(camera.scaled_to_width(0), InputError);
    EXPECT_THROW(camera.scaled_to_width(-5), InputError);
    EXPECT_THROW(camera.scaled_to_width(65537), InputError);
    EXPECT_THROW(camera.scaled_to_width(30000), InputError); // 90000 high
    EXPECT_THROW(Camera{}.scaled_to_width(100), InputError);
}

} // namespace
} // namespace degs
