// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/camera_path.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "scene/cameras/orbit_camera.hpp"

namespace degs {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

/// Opaque Gaussians at these places.
GaussianCloud cloud_at(const std::vector<glm::dvec3>& means) {
    GaussianCloud cloud;
    cloud.means = means;
    cloud.scales.assign(means.size(), glm::vec3(0.1F));
    cloud.rotations.assign(means.size(), glm::vec4(1, 0, 0, 0));
    cloud.opacities.assign(means.size(), 0.9F);
    cloud.sh.assign(means.size() * 3, 0.5F);
    return cloud;
}

Camera tilted_camera() {
    Camera camera = looking_at({3, -2, -5}, {0, 0.5, 1});
    camera.id = 4;
    camera.name = "tilted";
    camera.width = 640;
    camera.height = 480;
    camera.fx = 600;
    camera.fy = 610;
    return camera;
}

glm::dvec3 on_axis(const Camera& camera, double depth) {
    return camera.position + depth * camera.camera_to_world[2];
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LE(glm::length(a - b), tolerance);
}

TEST(CameraPath, StartsAtTheGivenCamera) {
    const Camera start = tilted_camera();
    const GaussianCloud cloud = cloud_at({on_axis(start, 4)});
    for (int frames : {1, 5}) {
        const std::vector<Camera> path = camera_path(cloud, start, frames);
        ASSERT_EQ(path.size(), static_cast<std::size_t>(frames));
        EXPECT_EQ(path[0].position, start.position);
        EXPECT_EQ(path[0].camera_to_world, start.camera_to_world);
        for (const Camera& camera : path) {
            EXPECT_EQ(camera.name, "tilted");
            EXPECT_EQ(camera.id, 4);
            EXPECT_EQ(camera.width, 640);
            EXPECT_EQ(camera.height, 480);
            EXPECT_EQ(camera.fx, 600);
            EXPECT_EQ(camera.fy, 610);
        }
    }
}

TEST(CameraPath, KeepsTheDistanceAndTheMiddleOfTheImage) {
    const Camera start = tilted_camera();
    const glm::dvec3 pivot = on_axis(start, 4);
    const std::vector<Camera> path = camera_path(cloud_at({pivot}), start, 800, 0.5);
    for (const Camera& camera : path) {
        expect_near(on_axis(camera, 4), pivot, 1e-12);
        const glm::dmat3& axes = camera.camera_to_world;
        const glm::dmat3 product = glm::transpose(axes) * axes;
        for (int i = 0; i < 3; ++i) {
            expect_near(product[i], glm::dmat3(1.0)[i], 1e-14);
        }
        EXPECT_NEAR(glm::determinant(axes), 1, 1e-14);
    }
    expect_near(path[720].position, start.position, 1e-12); // full circle
}

TEST(CameraPath, TurnsByTheSameAngleEveryFrame) {
    const Camera start = tilted_camera();
    for (double step : {0.5, -3.0, 90.0, 0.0}) {
        const std::vector<Camera> path = camera_path(cloud_at({on_axis(start, 2)}), start, 4, step);
        for (std::size_t k = 1; k < path.size(); ++k) {
            const glm::dvec3 before = path[k - 1].camera_to_world[2];
            const glm::dvec3 after = path[k].camera_to_world[2];
            EXPECT_NEAR(glm::dot(before, after), std::cos(step * kDegree), 1e-12);
            // Right-handed about the image's down axis: the camera looks to the right, moves left.
            const double sine = glm::dot(glm::cross(before, after), start.camera_to_world[1]);
            EXPECT_NEAR(sine, std::sin(step * kDegree), 1e-12);
            expect_near(path[k].camera_to_world[1], start.camera_to_world[1], 1e-12);
        }
    }
}

TEST(CameraPath, PivotIsTheMedianDepthOfWhatIsSeen) {
    const Camera start = tilted_camera();
    std::vector<glm::dvec3> means{on_axis(start, 3), on_axis(start, 4), on_axis(start, 5)};
    // Each of the others would move the median, the nearer ones together.
    means.push_back(on_axis(start, 0.1));                                // before the near plane
    means.push_back(on_axis(start, 0.15));                               // likewise
    means.push_back(on_axis(start, -7));                                 // behind
    means.push_back(on_axis(start, 9) + 9.0 * start.camera_to_world[0]); // beside the image
    means.push_back(on_axis(start, 9) + 9.0 * start.camera_to_world[1]); // below it
    means.push_back(on_axis(start, 9));
    GaussianCloud cloud = cloud_at(means);
    cloud.opacities.back() = 1e-3F; // transparent
    expect_near(path_pivot(cloud, start), on_axis(start, 4), 1e-12);
    // One thing in the sky does not move it.
    cloud = cloud_at({means[0], means[1], means[1], on_axis(start, 1e9)});
    expect_near(path_pivot(cloud, start), on_axis(start, 4), 1e-12);
}

TEST(CameraPath, OfACameraThatSeesNothing) {
    const Camera start = tilted_camera();
    const GaussianCloud cloud = cloud_at({on_axis(start, -7), on_axis(start, -8)});
    expect_near(path_pivot(cloud, start), on_axis(start, 8), 1e-12);
    EXPECT_EQ(camera_path(cloud, start, 3).size(), 3U);
    EXPECT_EQ(camera_path(cloud_at({start.position}), start, 3)[2].position, start.position);
}

TEST(HostileCameraPath, ImpossibleRequests) {
    const Camera start = tilted_camera();
    const GaussianCloud cloud = cloud_at({on_axis(start, 4)});
    EXPECT_THROW(camera_path(cloud, start, 0), InputError);
    EXPECT_THROW(camera_path(cloud, start, -3), InputError);
    for (double step : {90.1, -1e300, std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(camera_path(cloud, start, 2, step), InputError);
    }
}

} // namespace
} // namespace degs
