// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_cameras.hpp"

#include <nlohmann/json.hpp>

#include "scene/cameras/camera_file.hpp"
#include "scene/cameras/orbit_camera.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs::sim {
namespace {

TEST(SceneCameras, AreWrittenAsTheyAreRead) {
    const test::Folder folder;
    Scene scene = load_scene("synthetic:uniform,gaussians=100");
    scene.cameras.push_back(orbit_camera(scene.cloud));
    const std::string file =
        folder.write("cameras.json", cameras_json(scene.cameras, scene.generated_view).dump());
    const std::vector<Camera> read = read_camera_file(file).cameras;
    ASSERT_EQ(read.size(), 4U);
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].name, scene.cameras[i].name);
        EXPECT_EQ(read[i].width, scene.cameras[i].width);
        EXPECT_EQ(read[i].fx, scene.cameras[i].fx); // every digit
        EXPECT_EQ(read[i].position, scene.cameras[i].position);
        EXPECT_EQ(read[i].camera_to_world, scene.cameras[i].camera_to_world);
    }
}

TEST(SceneCameras, HaveOneLineEach) {
    Scene scene;
    Camera camera = looking_at({0, 0, -6}, {0, 0, 0});
    camera.name = "front";
    camera.width = 640;
    camera.height = 480;
    camera.fx = camera.fy = 320;
    scene.cameras = {camera};
    const std::string text = cameras_text(scene);
    EXPECT_THAT(text, testing::StartsWith("camera 0  640×480 front · at (0, 0, -6.00)"));
    EXPECT_THAT(text, testing::HasSubstr("looks along (0, 0, 1.00)"));
    EXPECT_THAT(text, testing::HasSubstr("90.0° × 73.7°"));
}

} // namespace
} // namespace degs::sim
