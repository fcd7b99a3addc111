// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "scene/cameras/lens_terms.hpp"
#include "tests/scene/cameras/camera_builder.hpp"

namespace degs {
namespace {

using test::colmap_cameras;
using test::colmap_images;
using test::ColmapImage;
using test::ColmapLens;

constexpr double kHalf = 0.70710678118654752440;

/// A quarter turn about y (world x comes to lie along the view axis) and a shift.
ColmapImage turned(const std::string& name, std::uint64_t points) {
    return {7, 3, {kHalf, 0, -kHalf, 0}, {1, 2, 3}, name, points};
}

void expect_turned(const Camera& camera) {
    EXPECT_EQ(camera.id, 7);
    EXPECT_EQ(camera.width, 64);
    EXPECT_EQ(camera.height, 48);
    EXPECT_EQ(camera.fx, 50.5);
    EXPECT_EQ(camera.fy, 51);
    // R = rows (0 0 -1), (0 1 0), (1 0 0): the third row is the view axis in world space, and the
    // centre is -R^T t.
    EXPECT_LT(glm::length(camera.camera_to_world[0] - glm::dvec3(0, 0, -1)), 1e-12);
    EXPECT_LT(glm::length(camera.camera_to_world[1] - glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LT(glm::length(camera.camera_to_world[2] - glm::dvec3(1, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(camera.position - glm::dvec3(-3, -2, 1)), 1e-12);
}

struct ColmapFolder : test::Folder {
    std::string put(const std::string& cameras, const std::string& images,
                    const std::string& extension, const std::string& folder = "model") const {
        write(folder + "/cameras" + extension, cameras);
        write(folder + "/images" + extension, images);
        return path(folder);
    }
};

TEST(Colmap, ReadsBinaryModels) {
    const ColmapFolder folder;
    const ColmapLens lens{3, 1, 64, 48, {50.5, 51, 32, 24}};
    const ColmapLens simple{1, 0, 640, 480, {500, 320, 240}};
    ColmapImage first;
    first.name = "z.jpg";
    first.points = 2;
    const std::string model = folder.put(colmap_cameras({lens, simple}),
                                         colmap_images({first, turned("b/c d.jpg", 5)}), ".bin");
    const CameraFile file = read_camera_file(model);
    ASSERT_EQ(file.cameras.size(), 2U);
    EXPECT_EQ(file.cameras[0].name, "b/c d.jpg"); // in the order of the names
    expect_turned(file.cameras[0]);
    EXPECT_EQ(file.cameras[1].name, "z.jpg");
    EXPECT_EQ(file.cameras[1].fx, 500);
    EXPECT_EQ(file.cameras[1].fy, 500);
    EXPECT_EQ(file.cameras[1].camera_to_world, glm::dmat3(1.0));
    EXPECT_TRUE(file.notes.empty());
    for (const char* one : {"/cameras.bin", "/images.bin"}) {
        EXPECT_EQ(read_camera_file(model + one).cameras.size(), 2U) << one;
    }
}

TEST(Colmap, ReadsTextModels) {
    const ColmapFolder folder;
    const std::string model = folder.put(
        "# Camera list\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n\n"
        "3 PINHOLE 64 48 50.5 51 32 24\r\n1 SIMPLE_PINHOLE 640 480 5e2 320 240\n",
        "# Image list\n7 0.70710678118654752440 0 -0.70710678118654752440 0 1 2 3 3 b/c d.jpg\n"
        "1.5 2 -1 3 4 77\n9 1 0 0 0 0 0 0 1 z.jpg\n\n",
        ".txt");
    const CameraFile file = read_camera_file(model);
    ASSERT_EQ(file.cameras.size(), 2U);
    EXPECT_EQ(file.cameras[0].name, "b/c d.jpg");
    expect_turned(file.cameras[0]);
    EXPECT_EQ(file.cameras[1].id, 9);
    EXPECT_EQ(file.cameras[1].fy, 500);
    // The last line may lack its end, and the empty line of points, too.
    folder.put("1 SIMPLE_PINHOLE 640 480 5e2 320 240", "9 1 0 0 0 0 0 0 1 z.jpg", ".txt", "short");
    EXPECT_EQ(read_camera_file(folder.path("short")).cameras.size(), 1U);
}

TEST(Colmap, PrefersBinaryFilesAndLooksIntoSparse) {
    const ColmapFolder folder;
    folder.put("1 SIMPLE_PINHOLE 9 9 5 4.5 4.5\n", "9 1 0 0 0 0 0 0 1 text\n\n", ".txt",
               "data/sparse/0");
    EXPECT_EQ(read_camera_file(folder.path("data")).cameras.at(0).name, "text");
    folder.put(colmap_cameras({ColmapLens{}}), colmap_images({ColmapImage{}}), ".bin",
               "data/sparse/0");
    EXPECT_EQ(read_camera_file(folder.path("data")).cameras.at(0).name, "a.jpg");
    EXPECT_EQ(read_camera_file(folder.path("data/sparse")).cameras.at(0).name, "a.jpg");
    EXPECT_EQ(read_camera_file(folder.path("data/sparse/0/images.txt")).cameras.at(0).name, "text");
}

TEST(Colmap, LensesMoveTheCorner) {
    const ColmapFolder folder;
    const auto shift_of = [&](const ColmapLens& lens) {
        const CameraFile file = read_camera_file(
            folder.put(colmap_cameras({lens}), colmap_images({ColmapImage{}}), ".bin"));
        EXPECT_TRUE(file.notes.empty()); // the view says what is left out
        return corner_shift(file.cameras.at(0));
    };
    // The corner is at x = 0.32, y = 0.24 in units of the focal length: r^2 = 0.16, r f = 40 px.
    const ColmapLens radial{1, 2, 64, 48, {100, 32, 24, 0.1}};
    EXPECT_NEAR(shift_of(radial), 0.64, 1e-9);
    const ColmapLens opencv{1, 4, 64, 48, {100, 100, 32, 24, 0, 0, 0, 0}};
    EXPECT_EQ(shift_of(opencv), 0);
    const ColmapLens full{1, 6, 64, 48, {100, 100, 29, 24, 0, 0, 0, 0, 0, 0, 0, 0}};
    EXPECT_EQ(shift_of(full), 0);
    const ColmapLens wide{1, 3, 64, 48, {100, 32, 24, 0, 1}};
    EXPECT_NEAR(shift_of(wide), 40 * 0.16 * 0.16, 1e-9);
    const ColmapLens tangential{1, 4, 64, 48, {100, 100, 32, 24, 0, 0, 0.01, 0}};
    // dx = 2 p1 x y = 0.001536, dy = p1 (r^2 + 2 y^2) = 0.002752
    EXPECT_NEAR(shift_of(tangential), 100 * std::hypot(0.001536, 0.002752), 1e-9);
}

} // namespace
} // namespace degs
