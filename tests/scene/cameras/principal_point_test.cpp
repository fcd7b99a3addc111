// SPDX-License-Identifier: Apache-2.0
// Principal points off the middle, in every format of cameras.
#include "scene/gltf/gltf.hpp"
#include "scene/scene.hpp"
#include "tests/scene/cameras/camera_builder.hpp"
#include "tests/scene/cameras/seen_pixel.hpp"

namespace degs::test {
namespace {

/// cx, cy of an image of 64 x 48 px: in the middle, right and left of it, and beyond the image.
std::vector<glm::dvec2> points() {
    return {{32, 24}, {40.25, 19.5}, {21.7, 30.1}, {31.8, 24.2}, {-12.5, 66}};
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

Camera only_camera(const std::string& path) {
    const CameraFile file = read_camera_file(path);
    EXPECT_EQ(file.cameras.size(), 1U);
    EXPECT_TRUE(file.notes.empty());
    return file.cameras.at(0);
}

TEST(PrincipalPoints, OfCamerasJson) {
    for (const glm::dvec2& c : points()) {
        const Folder folder;
        const std::string path = folder.write(
            "cameras.json", R"([{"width": 64, "height": 48, "fx": 50.5, "fy": 51, "cx": )" +
                                number(c.x) + R"(, "cy": )" + number(c.y) +
                                R"(, "position": [1, 2, 3],
                                "rotation": [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}])");
        const glm::dmat3 to_world(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
        const glm::dmat3 to_camera = glm::transpose(to_world);
        expect_pixels(only_camera(path),
                      {{50.5, 51, c.x, c.y}, to_camera, -(to_camera * glm::dvec3(1, 2, 3))});
    }
}

TEST(PrincipalPoints, OfTransformsJson) {
    for (const glm::dvec2& c : points()) {
        const Folder folder;
        const std::string path = folder.write(
            "transforms.json", R"({"w": 64, "h": 48, "fl_x": 50.5, "fl_y": 51, "cx": )" +
                                   number(c.x) + R"(, "cy": )" + number(c.y) +
                                   R"(, "frames": [{"transform_matrix":
                                   [[1,0,0,1],[0,-1,0,2],[0,0,-1,3],[0,0,0,1]]}]})");
        expect_pixels(only_camera(path), {{50.5, 51, c.x, c.y}, glm::dmat3(1.0), {-1, -2, -3}});
    }
}

TEST(PrincipalPoints, OfColmapModels) {
    for (const glm::dvec2& c : points()) {
        const Folder folder;
        ColmapImage image;
        image.translation[0] = 0.5;
        folder.write("model/cameras.bin",
                     colmap_cameras({ColmapLens{1, 1, 64, 48, {50.5, 51, c.x, c.y}}}));
        folder.write("model/images.bin", colmap_images({image}));
        const PlainCamera plain{{50.5, 51, c.x, c.y}, glm::dmat3(1.0), {0.5, 0, 0}};
        expect_pixels(only_camera(folder.path("model")), plain);
        folder.write("text/cameras.txt",
                     "1 PINHOLE 64 48 50.5 51 " + number(c.x) + " " + number(c.y) + "\n");
        folder.write("text/images.txt", "1 1 0 0 0 0.5 0 0 1 a.jpg\n\n");
        expect_pixels(only_camera(folder.path("text")), plain);
    }
}

// glTF's own camera is symmetric; the extras say the rest, as they do with the size of the image.
TEST(PrincipalPoints, OfTheExtrasOfGltf) {
    for (const glm::dvec2& c : points()) {
        Camera camera = make_camera(64, 48, 50.5);
        camera.fy = 51;
        ASSERT_TRUE(camera.set_principal_point(c));
        const Folder folder;
        write_glb(random_cloud(3, 1), {camera}, {}, folder.path("scene.glb"));
        const Scene back = load_scene(folder.path("scene.glb"));
        ASSERT_EQ(back.cameras.size(), 1U);
        expect_pixels(back.cameras[0], {{50.5, 51, c.x, c.y}});
    }
}

TEST(HostilePrincipalPoints, TooFarAreRefused) {
    const Folder folder;
    const std::string path = folder.write(
        "cameras.json", R"([{"width": 64, "height": 48, "fx": 50, "fy": 50, "cx": 1e9, "cy": 24,
        "position": [1, 2, 3], "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}])");
    EXPECT_THAT(complaint([&] { read_camera_file(path); }),
                IsSentenceWith("too far from the middle"));
}

} // namespace
} // namespace degs::test
