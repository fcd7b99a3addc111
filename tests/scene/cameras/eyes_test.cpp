// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/eyes.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace degs {
namespace {

/// Turned by `angle` about the vertical axis, with a lens that is off its middle.
Camera turned_head(double angle) {
    Camera camera;
    camera.width = 2064;
    camera.height = 2208;
    camera.fx = camera.fy = 1100;
    camera.position = {3, -1, 7};
    const double c = std::cos(angle), s = std::sin(angle);
    camera.camera_to_world = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    camera.set_principal_point({900, 1200});
    return camera;
}

TEST(Eyes, AreHalfADistanceOnBothSidesOfTheHead) {
    const Camera head = turned_head(0.4);
    const std::vector<Camera> eyes = eyes_of(head, 0.064);
    ASSERT_EQ(eyes.size(), 2U);
    const glm::dvec3 way = eyes[1].position - eyes[0].position;
    EXPECT_NEAR(way.x, 0.064 * std::cos(0.4), 1e-15);
    EXPECT_NEAR(way.y, 0, 1e-15);
    EXPECT_NEAR(way.z, -0.064 * std::sin(0.4), 1e-15);
    const glm::dvec3 off = middle_of(eyes) - head.position;
    EXPECT_LT(std::abs(off.x) + std::abs(off.y) + std::abs(off.z), 1e-15);
    for (const Camera& eye : eyes) {
        EXPECT_EQ(eye.camera_to_world, head.camera_to_world);
        EXPECT_EQ(eye.shift, head.shift);
        EXPECT_EQ(eye.fx, head.fx);
        EXPECT_EQ(eye.width, head.width);
        EXPECT_EQ(eye.height, head.height);
    }
}

TEST(Eyes, AtOnePlaceAreTheHead) {
    const Camera head = turned_head(-2);
    for (const Camera& eye : eyes_of(head, 0)) {
        EXPECT_EQ(eye.position, head.position);
    }
}

TEST(Eyes, ANearPointIsSeenFartherToTheLeftByTheRightOne) {
    Camera head = turned_head(0);
    const std::vector<Camera> eyes = eyes_of(head, 0.064);
    // The disparity of a point at depth z is fx x distance / z; both see it at the same depth.
    const glm::dvec3 point = head.position + glm::dvec3(0, 0, 2);
    ASSERT_TRUE(eyes[0].seen_depth(point).has_value());
    EXPECT_DOUBLE_EQ(*eyes[0].seen_depth(point), *eyes[1].seen_depth(point));
    const auto column = [&](const Camera& eye) {
        return eye.fx * (point.x - eye.position.x) / (point.z - eye.position.z);
    };
    EXPECT_NEAR(column(eyes[0]) - column(eyes[1]), 1100 * 0.064 / 2, 1e-9);
}

} // namespace
} // namespace degs
