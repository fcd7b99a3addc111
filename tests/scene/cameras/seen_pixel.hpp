// SPDX-License-Identifier: Apache-2.0
// Where cameras put points, by the program and by a few lines of their own.
#pragma once

#include <gtest/gtest.h>

#include "splat/frame/projection.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs::test {

/// A camera as a file says it, independent of Camera.
struct PlainCamera {
    glm::dvec4 lens; ///< fx, fy, cx, cy; the centre of the first pixel is at 0.5, 0.5
    glm::dmat3 world_to_camera{1.0}; ///< columns
    glm::dvec3 translation{0.0};

    glm::dvec2 pixel_of(const glm::dvec3& point) const {
        const glm::dvec3 p = world_to_camera * point + translation;
        return {lens[0] * p.x / p.z + lens[2], lens[1] * p.y / p.z + lens[3]};
    }
};

/// Random points in front of the camera, within and beyond the image, lie where the file puts them.
inline void expect_pixels(const Camera& camera, const PlainCamera& plain) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const double z = 3 + 2 * uniform(random);
        const glm::dvec3 seen(z * uniform(random), z * uniform(random), z);
        const glm::dvec3 point = glm::transpose(plain.world_to_camera) * (seen - plain.translation);
        GaussianCloud cloud;
        add_gaussian(cloud, point, glm::vec3(0.01F), {1, 0, 0, 0}, 0.9F, glm::vec3(1));
        ProjectedSplat splat;
        ASSERT_EQ(project_anywhere(cloud, 0, camera, {}, splat), Cull::None);
        const glm::dvec2 wanted = plain.pixel_of(cloud.means[0]);
        EXPECT_NEAR(splat.mu_x + 0.5 - camera.origin.x, wanted.x, 1e-6);
        EXPECT_NEAR(splat.mu_y + 0.5 - camera.origin.y, wanted.y, 1e-6);
    }
}

} // namespace degs::test
