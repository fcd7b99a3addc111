// SPDX-License-Identifier: Apache-2.0
// The view of the photograph that a PLY of SHARP holds beside its Gaussians.
#include "scene/ply/ply_camera.hpp"

#include <cmath>

#include "scene/scene.hpp"
#include "tests/scene/cameras/seen_pixel.hpp"
#include "tests/scene/ply/ply_builder.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::PlyBuilder;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct SharpBuilder {
    std::string format = "binary_little_endian";
    std::vector<double> extrinsic{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::vector<double> intrinsic{500, 0, 320, 0, 510, 240, 0, 0, 1};
    std::vector<double> image_size{640, 480}, color_space{0};
    bool before = false; ///< in front of the vertices

    std::string file() const {
        PlyBuilder ply = PlyBuilder::splat();
        ply.format = format;
        for (int row = 0; row < 4; ++row) {
            ply.add_row([row](const std::string& name) { return name == "z" ? 3.0 + row : -1.0; });
        }
        std::string header, body;
        const auto add = [&](const std::string& name, const std::string& type,
                             const std::vector<double>& values) {
            header += values.empty() ? ""
                                     : "element " + name + " " + std::to_string(values.size()) +
                                           "\nproperty " + type + " " + name + "\n";
            for (const double value : values) {
                body += ply.encode(type, value) + (format == "ascii" ? "\n" : "");
            }
        };
        add("extrinsic", "float", extrinsic);
        add("intrinsic", "float", intrinsic);
        add("image_size", "uint", image_size);
        add("disparity", "float", {1, 2});
        add("color_space", "uchar", color_space);
        (before ? ply.before : ply.after) = header;
        (before ? ply.body_before : ply.body_after) = body;
        return ply.file();
    }
};

Scene scene_of(const SharpBuilder& sharp) {
    const test::Folder folder;
    return load_scene(folder.write("s.ply", sharp.file()));
}

TEST(PlyCamera, IsTheViewOfTheScene) {
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        for (const bool before : {false, true}) {
            SharpBuilder sharp;
            sharp.format = format;
            sharp.before = before;
            const Scene scene = scene_of(sharp);
            ASSERT_EQ(scene.cameras.size(), 1U);
            const Camera& camera = scene.cameras[0];
            EXPECT_EQ(camera.width, 640);
            EXPECT_EQ(camera.height, 480);
            EXPECT_EQ(camera.fx, 500);
            EXPECT_EQ(camera.fy, 510);
            EXPECT_EQ(camera.position, glm::dvec3(0));
            EXPECT_EQ(camera.camera_to_world, glm::dmat3(1));
            EXPECT_TRUE(scene.notes.empty());
            EXPECT_EQ(scene.cloud.size(), 4U);
        }
    }
}

TEST(PlyCamera, ExtrinsicIsFromWorldToCamera) {
    SharpBuilder sharp;
    sharp.extrinsic = {0, 1, 0, 2, -1, 0, 0, 3, 0, 0, 1, 4, 0, 0, 0, 1};
    const Camera camera = scene_of(sharp).cameras[0];
    const glm::dvec3 seen = glm::transpose(camera.camera_to_world) * -camera.position;
    EXPECT_EQ(seen, glm::dvec3(2, 3, 4)); // the origin of the world
    EXPECT_EQ(camera.camera_to_world[0], glm::dvec3(0, 1, 0));
    sharp.extrinsic = {0, -1, 0, 2, 1, 0, 0, 3, 0, 0, 1, 4}; // of older files, column by column
    EXPECT_EQ(scene_of(sharp).cameras[0].camera_to_world, camera.camera_to_world);
    EXPECT_EQ(scene_of(sharp).cameras[0].position, camera.position);
}

TEST(PlyCamera, OlderFilesHaveTheSizeBesideTheFocalLengths) {
    SharpBuilder sharp;
    sharp.intrinsic = {500, 510, 64, 48};
    sharp.image_size.clear();
    const Camera camera = scene_of(sharp).cameras[0];
    EXPECT_EQ(camera.width, 64);
    EXPECT_EQ(camera.height, 48);
    EXPECT_EQ(camera.fy, 510);
}

TEST(PlyCamera, IsCountedWithoutTheGaussiansAndYieldsToAFile) {
    const test::Folder folder;
    const std::string scene = folder.write("s.ply", SharpBuilder().file());
    EXPECT_EQ(read_ply_cameras(scene).size(), 1U);
    EXPECT_EQ(camera_count(scene), 1U);
    const std::string cameras = folder.write(
        "other.json", R"([{"width": 32, "height": 16, "fx": 20, "fy": 20, "position": [0, 0, -6],
            "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}])");
    EXPECT_EQ(load_scene(scene, cameras).cameras[0].width, 32);
}

TEST(PlyCamera, LinearColoursAreAWarning) {
    SharpBuilder sharp;
    sharp.color_space = {1};
    EXPECT_THAT(scene_of(sharp).notes, Contains(IsSentenceWith("The colours are linear")));
    sharp.color_space = {7};
    EXPECT_THAT(scene_of(sharp).notes, Contains(IsSentenceWith("color_space 7")));
    sharp.color_space = {};
    EXPECT_THAT(scene_of(sharp).notes, Not(Contains(HasSubstr("colo"))));
}

TEST(PlyCamera, PrincipalPointsAreWhereTheFilePutsThem) {
    SharpBuilder sharp;
    sharp.intrinsic[2] = 300;
    test::expect_pixels(scene_of(sharp).cameras.at(0), {{500, 510, 300, 240}});
    EXPECT_THAT(scene_of(sharp).notes, Not(Contains(HasSubstr("principal"))));
    sharp.intrinsic[2] = 1e7F;
    EXPECT_THAT(test::complaint([&] { scene_of(sharp); }),
                IsSentenceWith("too far from the middle"));
}

TEST(PlyCamera, OtherNumbersAreNoCamera) {
    SharpBuilder sharp;
    sharp.intrinsic.pop_back();
    const Scene scene = scene_of(sharp);
    EXPECT_THAT(scene.notes, Contains(IsSentenceWith("8, 16 and 2 numbers")));
    EXPECT_EQ(scene.cameras.size(), 1U); // generated
    const auto refusal = [](const SharpBuilder& bad) {
        return test::complaint([&] { scene_of(bad); });
    };
    sharp = {};
    sharp.intrinsic[0] = 0;
    EXPECT_THAT(refusal(sharp), IsSentenceWith("focal length fx of 0"));
    sharp = {};
    sharp.intrinsic[4] = NAN;
    EXPECT_THAT(refusal(sharp), IsSentenceWith("focal length fy"));
    sharp = {};
    sharp.image_size[1] = 70000;
    EXPECT_THAT(refusal(sharp), IsSentenceWith("height of 70000"));
    sharp = {};
    sharp.extrinsic[0] = 2;
    EXPECT_THAT(refusal(sharp), IsSentenceWith("orthogonal unit vectors"));
    sharp = {};
    sharp.extrinsic[3] = INFINITY;
    EXPECT_THAT(refusal(sharp), IsSentenceWith("not finite"));
}

} // namespace
} // namespace degs
