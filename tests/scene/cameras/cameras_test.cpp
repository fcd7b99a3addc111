// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/orbit_camera.hpp"

#include "splat/frame/projection.hpp"
#include "tests/scene/cameras/camera_builder.hpp"

namespace degs {
namespace {

TEST(Cameras, AreReadWithRowsOfTheRotation) {
    const test::Folder folder;
    const std::vector<Camera> cameras = test::read_cameras_of(folder.write("cameras.json", R"([
        {"id": 7, "img_name": "left", "width": 640, "height": 480, "position": [1, -2.5, 3e-1],
         "rotation": [[0, 0, 1], [1, 0, 0], [0, 1, 0]], "fx": 500.25, "fy": 501, "extra": null},
        {"width": 64.0, "height": 65536, "position": [0, 0, 0],
         "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1.0004]], "fx": 1, "fy": 1}])"));
    ASSERT_EQ(cameras.size(), 2U);
    EXPECT_EQ(cameras[0].id, 7);
    EXPECT_EQ(cameras[0].name, "left");
    EXPECT_EQ(cameras[0].width, 640);
    EXPECT_EQ(cameras[0].height, 480);
    EXPECT_EQ(cameras[0].fx, 500.25);
    EXPECT_EQ(cameras[0].fy, 501);
    EXPECT_EQ(cameras[0].position, glm::dvec3(1, -2.5, 0.3));
    // Columns are the view axes: here x is world y, y is world z, z (forward) is world x.
    EXPECT_EQ(cameras[0].camera_to_world[0], glm::dvec3(0, 1, 0));
    EXPECT_EQ(cameras[0].camera_to_world[2], glm::dvec3(1, 0, 0));
    EXPECT_EQ(cameras[1].id, 1); // the camera's place in the array
    EXPECT_EQ(cameras[1].name, "camera 1");
    EXPECT_EQ(cameras[1].height, 65536);
}

TEST(Cameras, ThatLookAtATargetSeeItInTheMiddleAndUpright) {
    const glm::dvec3 targets[] = {
        {0, 0, 0}, {5, -3, 2}, {1, 9, 2}, {1, -9, 2}}; // last: up and down
    for (const glm::dvec3& target : targets) {
        const Camera camera = looking_at({1, 2, 2}, target);
        const glm::dmat3& axes = camera.camera_to_world;
        EXPECT_NEAR(glm::determinant(axes), 1, 1e-12);
        EXPECT_LT(glm::length(glm::transpose(axes) * axes[2] - glm::dvec3(0, 0, 1)), 1e-12);
        const glm::dvec3 seen = glm::transpose(axes) * (target - camera.position);
        EXPECT_NEAR(seen.x, 0, 1e-12);
        EXPECT_NEAR(seen.y, 0, 1e-12);
        EXPECT_GT(seen.z, 0);
        EXPECT_GE(axes[1].y, -1e-12); // the image's down is not the world's up
    }
}

GaussianCloud cluster(double size, const glm::dvec3& centre, int outliers) {
    GaussianCloud cloud;
    const auto add = [&](const glm::dvec3& mean) {
        cloud.means.push_back(mean);
        cloud.scales.emplace_back(static_cast<float>(size / 100));
        cloud.rotations.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
        cloud.opacities.push_back(0.5F);
        cloud.sh.insert(cloud.sh.end(), 3, 0.0F);
    };
    for (int i = 0; i < 1000; ++i) {
        add(centre + size * glm::dvec3(i % 10 - 4.5, i / 10 % 10 - 4.5, i / 100 - 4.5) / 9.0);
    }
    for (int i = 0; i < outliers; ++i) {
        add(centre + 1e4 * size * glm::dvec3(1, 0.5, 0.25));
    }
    return cloud;
}

TEST(OrbitCamera, ShowsTheMiddleOfTheSceneDespiteOutliers) {
    for (const double size : {1e-3, 1.0, 1e4}) {
        const GaussianCloud cloud = cluster(size, {size, -2 * size, 3 * size}, 60);
        const Camera camera = orbit_camera(cloud);
        int seen = 0;
        for (std::size_t i = 0; i < 1000; ++i) {
            ProjectedSplat splat;
            seen += static_cast<int>(project(cloud, i, camera, {}, splat) == Cull::None);
        }
        EXPECT_EQ(seen, 1000) << size;
        EXPECT_EQ(camera.name, "orbit");
    }
}

/// A pole: most Gaussians are at its foot, and its top is as far away as an object reaches.
TEST(OrbitCamera, FramesAllOfAnElongatedObject) {
    GaussianCloud cloud = cluster(1, {0, 0, 0}, 0);
    for (std::size_t i = 0; i < 150; ++i) {
        cloud.means[i] = {0, -1.0 * static_cast<double>(i) / 150, 0};
    }
    const Camera camera = orbit_camera(cloud);
    int seen = 0;
    double highest = camera.height;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ProjectedSplat splat;
        seen += static_cast<int>(project(cloud, i, camera, {}, splat) == Cull::None);
        highest = std::min(highest, splat.mu_y);
    }
    EXPECT_EQ(seen, 1000);
    EXPECT_GT(highest, 0);                    // nothing is cut off,
    EXPECT_LT(highest, 0.18 * camera.height); // and little room is wasted
}

TEST(OrbitCamera, FramesASingleGaussian) {
    GaussianCloud cloud = cluster(1, {0, 0, 0}, 0);
    cloud.means.resize(1);
    cloud.scales.resize(1);
    const Camera camera = orbit_camera(cloud);
    ProjectedSplat splat;
    ASSERT_EQ(project(cloud, 0, camera, {}, splat), Cull::None);
    EXPECT_NEAR(splat.mu_x, camera.width / 2.0 - 0.5, 1e-6);
    EXPECT_NEAR(splat.mu_y, camera.height / 2.0 - 0.5, 1e-6);
}

TEST(OrbitCamera, ObeysItsOptions) {
    const GaussianCloud cloud = cluster(1, {0, 0, 0}, 0);
    OrbitOptions options;
    options.azimuth_degrees = 0;
    options.elevation_degrees = 0;
    options.width = 320;
    options.height = 240;
    options.field_of_view_degrees = 90;
    const Camera front = orbit_camera(cloud, options);
    EXPECT_NEAR(front.fx, 160, 1e-9);
    EXPECT_LT(glm::length(front.camera_to_world[2] - glm::dvec3(0, 0, 1)), 1e-9);
    options.elevation_degrees = 30;
    options.distance = 2;
    const Camera above = orbit_camera(cloud, options);
    EXPECT_LT(above.position.y, -0.1); // up is -y
    options.distance = 1;
    const double once = glm::length(orbit_camera(cloud, options).position);
    EXPECT_NEAR(glm::length(above.position), 2 * once, 1e-9);
    EXPECT_NEAR(field_of_view(front).x, 90, 1e-9);
    EXPECT_NEAR(field_of_view(front).y, 73.7398, 1e-4); // 2 atan(0.75)
}

} // namespace
} // namespace degs
