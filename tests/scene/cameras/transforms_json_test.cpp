// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "scene/cameras/lens_terms.hpp"
#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/cameras/camera_builder.hpp"

namespace degs {
namespace {

constexpr const char* kHome = "[[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]";

CameraFile transforms(const std::string& text) {
    const test::Folder folder;
    return read_camera_file(folder.write("transforms.json", text));
}

TEST(TransformsJson, HasTheAxesOfOpenGl) {
    // The camera's x is world y, its up is world z, and it looks along -x: its back is +x.
    const CameraFile file = transforms(R"({"w": 64, "h": 48.0, "fl_x": 50.5, "fl_y": 51, "cx": 32,
        "cy": 24, "aabb_scale": 16, "frames": [{"file_path": "./images/frame_00007.jpg",
        "sharpness": 1, "transform_matrix": [[0,0,1,1],[1,0,0,2],[0,1,0,3],[0,0,0,1]]}]})");
    ASSERT_EQ(file.cameras.size(), 1U);
    const Camera& camera = file.cameras[0];
    EXPECT_EQ(camera.id, 0);
    EXPECT_EQ(camera.name, "frame_00007");
    EXPECT_EQ(camera.width, 64);
    EXPECT_EQ(camera.height, 48);
    EXPECT_EQ(camera.fx, 50.5);
    EXPECT_EQ(camera.fy, 51);
    EXPECT_EQ(camera.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(camera.camera_to_world[0], glm::dvec3(0, 1, 0));  // right
    EXPECT_EQ(camera.camera_to_world[1], glm::dvec3(0, 0, -1)); // down
    EXPECT_EQ(camera.camera_to_world[2], glm::dvec3(-1, 0, 0)); // forward
    EXPECT_TRUE(file.notes.empty());
}

TEST(TransformsJson, TakesFocalLengthsFromAngles) {
    const std::string frames = std::string(R"("frames": [{"transform_matrix": )") + kHome + "}]";
    const CameraFile file =
        transforms(R"({"camera_angle_x": 1.5707963267948966, "w": 200, "h": 100, )" + frames + "}");
    EXPECT_NEAR(file.cameras.at(0).fx, 100, 1e-9);
    EXPECT_NEAR(file.cameras.at(0).fy, 100, 1e-9); // square pixels
    const CameraFile both = transforms(
        R"({"camera_angle_x": 1.5707963267948966, "camera_angle_y": 1.5707963267948966, "w": 200,
            "h": 100, )" +
        frames + "}");
    EXPECT_NEAR(both.cameras.at(0).fy, 50, 1e-9);
    EXPECT_TRUE(both.notes.empty());
    // NeRF's synthetic scenes name no size.
    const CameraFile nerf = transforms("{\"camera_angle_x\": 0.6911, " + frames + "}");
    EXPECT_EQ(nerf.cameras.at(0).width, 800);
    EXPECT_EQ(nerf.cameras.at(0).height, 800);
    EXPECT_THAT(nerf.notes.at(0), test::IsSentenceWith("800 x 800 pixels are assumed"));
}

TEST(TransformsJson, FramesOverrideTheFile) {
    // Intrinsics may follow the frames.
    const CameraFile file = transforms(
        std::string(R"({"frames": [{"w": 20, "fl_y": 9, "transform_matrix": )") + kHome +
        R"(}, {"camera_angle_x": 1.5707963267948966, "k1": 0.5, "transform_matrix": )" + kHome +
        R"(}, {"transform_matrix": )" + kHome + R"(}], "w": 10, "h": 11, "fl_x": 5, "cx": 7})");
    ASSERT_EQ(file.cameras.size(), 3U);
    EXPECT_EQ(file.cameras[0].width, 20);
    EXPECT_EQ(file.cameras[0].height, 11);
    EXPECT_EQ(file.cameras[0].fx, 5);
    EXPECT_EQ(file.cameras[0].fy, 9);
    EXPECT_NEAR(file.cameras[1].fx, 5, 1e-9); // 10 px at a right angle
    EXPECT_EQ(file.cameras[1].width, 10);
    EXPECT_EQ(file.cameras[2].fy, 5);
    EXPECT_EQ(file.cameras[2].name, "frame 2");
    EXPECT_EQ(file.cameras[0].principal_point(), glm::dvec2(7, 5.5));
    EXPECT_EQ(file.cameras[0].origin, glm::ivec2(6, 0)); // 20 - 2 x 7 px
    EXPECT_EQ(file.cameras[2].origin, glm::ivec2(0, 0));
    EXPECT_GT(corner_shift(file.cameras[1]), 0.01);
}

TEST(TransformsJson, UndoesTheAppliedTransform) {
    // What nerfstudio applies to COLMAP's poses, with a scale and a shift.
    const CameraFile file =
        transforms(std::string(R"({"w": 64, "h": 48, "fl_x": 50, "applied_transform":
            [[0,2,0,1],[2,0,0,2],[0,0,-2,3]], "frames": [{"transform_matrix": )") +
                   "[[0,1,0,5],[1,0,0,8],[0,0,-1,9],[0,0,0,1]]}]}");
    const Camera& camera = file.cameras.at(0);
    // saved = A original: (5, 8, 9) = (2 y + 1, 2 x + 2, -2 z + 3)
    EXPECT_LT(glm::length(camera.position - glm::dvec3(3, 2, -3)), 1e-12);
    // Both turns are the same, so that the original camera has the axes of the world.
    EXPECT_LT(glm::length(camera.camera_to_world[0] - glm::dvec3(1, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(camera.camera_to_world[1] - glm::dvec3(0, -1, 0)), 1e-12);
    EXPECT_LT(glm::length(camera.camera_to_world[2] - glm::dvec3(0, 0, -1)), 1e-12);
    EXPECT_THAT(file.notes.at(0), test::IsSentenceWith("applied_transform"));
}

TEST(TransformsJson, UndoesTheAppliedScale) {
    const auto position = [](const std::string& applied) {
        return transforms(R"({"w": 64, "h": 48, "fl_x": 50, )" + applied +
                          R"("frames": [{"transform_matrix": )" + kHome + "}]}")
            .cameras.at(0)
            .position;
    };
    EXPECT_EQ(position(R"("applied_scale": 0.25, )"), glm::dvec3(4, 8, 12));
    EXPECT_EQ(
        position(R"("applied_scale": 2, "applied_transform": [[1,0,0,1],[0,1,0,0],[0,0,1,0]], )"),
        glm::dvec3(-0.5, 1, 1.5));
    for (const char* const wrong : {"0", "-1", "\"1\"", "null", "[1]"}) {
        EXPECT_THAT(
            test::complaint([&] { position(std::string("\"applied_scale\": ") + wrong + ", "); }),
            test::IsSentenceWith("applied_scale"))
            << wrong;
    }
}

TEST(TrainedFrame, MovesCamerasOfTheOriginalData) {
    const test::Folder folder;
    write_ply(make_synthetic({"object", 50, 1}).cloud, folder.path("s.ply"));
    const auto position = [&] { return load_scene(folder.path("s.ply")).cameras.at(0).position; };
    folder.write("transforms.json",
                 std::string(R"({"w": 64, "h": 48, "fl_x": 50, "frames": [{"transform_matrix": )") +
                     kHome + "}]}");
    EXPECT_EQ(position(), glm::dvec3(1, 2, 3));
    const auto frame = [&](const std::string& transform, const std::string& scale) {
        folder.write("dataparser_transforms.json",
                     "{\"transform\": " + transform + ", \"scale\": " + scale + "}");
    };
    frame("[[1,0,0,1],[0,1,0,0],[0,0,1,0]]", "0.5");
    EXPECT_EQ(position(), glm::dvec3(1, 1, 1.5));
    frame("[[0,1,0,0],[-1,0,0,0],[0,0,1,-3]]", "2");
    EXPECT_EQ(position(), glm::dvec3(4, -2, 0));
    EXPECT_EQ(load_scene(folder.path("s.ply")).cameras[0].camera_to_world[0], glm::dvec3(0, -1, 0));
    for (const auto& [transform, scale] : {std::pair("[[1,0,0,0],[0,1,0,0]]", "1"),
                                           std::pair("[[1,0,0,0],[0,1,0,0],[0,0,-1,0]]", "1"),
                                           std::pair("[[1,0,0,0],[0,1,0,0],[0,0,1,0]]", "0"),
                                           std::pair("[[1,0,0,0],[0,1,0,0],[0,0,1,0]]", "\"x\"")}) {
        frame(transform, scale);
        EXPECT_THAT(test::complaint(position), test::IsSentenceWith("dataparser_transforms.json"));
    }
    // cameras.json is in the coordinates of the scene, and the file is not looked at.
    folder.write("cameras.json", R"([{"width": 9, "height": 9, "fx": 5, "fy": 5, "cx": 7,
        "cy": 4.5, "position": [1, 2, 3], "rotation": [[1,0,0],[0,1,0],[0,0,1]]}])");
    EXPECT_EQ(position(), glm::dvec3(1, 2, 3));
    EXPECT_EQ(load_scene(folder.path("s.ply")).cameras.at(0).principal_point(), glm::dvec2(7, 4.5));
}

// A COLMAP model is in the coordinates of the original data as well, beside the scene and by its
// name.
TEST(TrainedFrame, MovesCamerasOfAColmapModel) {
    for (const bool binary : {false, true}) {
        const test::Folder folder;
        write_ply(make_synthetic({"object", 50, 1}).cloud, folder.path("s.ply"));
        if (binary) {
            const test::ColmapImage image{7, 1, {1, 0, 0, 0}, {-1, -2, -3}, "a.jpg", 0};
            folder.write("sparse/0/cameras.bin",
                         test::colmap_cameras({{1, 1, 64, 48, {50, 50, 32, 24}}}));
            folder.write("sparse/0/images.bin", test::colmap_images({image}));
        } else {
            folder.write("sparse/0/cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n");
            folder.write("sparse/0/images.txt", "7 1 0 0 0 -1 -2 -3 1 a.jpg\n\n");
        }
        for (const std::string& named : {std::string(), folder.path("sparse/0")}) {
            std::filesystem::remove(folder.path("dataparser_transforms.json"));
            EXPECT_EQ(load_scene(folder.path("s.ply"), named).cameras.at(0).position,
                      glm::dvec3(1, 2, 3));
            folder.write("dataparser_transforms.json",
                         R"({"transform": [[0,1,0,0],[-1,0,0,0],[0,0,1,-3]], "scale": 2})");
            const Scene scene = load_scene(folder.path("s.ply"), named);
            EXPECT_EQ(scene.cameras.at(0).position, glm::dvec3(4, -2, 0));
            EXPECT_EQ(scene.cameras.at(0).camera_to_world[0], glm::dvec3(0, -1, 0));
            EXPECT_THAT(scene.notes,
                        testing::Contains(test::IsSentenceWith("are moved by " + folder.path(""))));
            folder.write("dataparser_transforms.json", R"({"scale": 2})");
            EXPECT_THAT(test::complaint([&] { load_scene(folder.path("s.ply"), named); }),
                        test::IsSentenceWith("dataparser_transforms.json"));
        }
    }
}

} // namespace
} // namespace degs
