// SPDX-License-Identifier: Apache-2.0
// Which camera file a scene gets, and what it is taken for.
#include "scene/scene.hpp"

#include "scene/ply/ply.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/cameras/camera_builder.hpp"

namespace degs {
namespace {

const char* const kTransformsOfOne =
    R"({"w":9,"h":9,"fl_x":5,"frames":[{"file_path":"t.png",
        "transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,0]]}]})";
const char* const kCamerasOfOne = R"([{"width":9,"height":9,"fx":5,"fy":5,"img_name":"j",
        "position":[0,0,0],"rotation":[[1,0,0],[0,1,0],[0,0,1]]}])";

std::string put_scene(const test::Folder& folder, const std::string& name) {
    folder.write(name, "");
    write_ply(make_synthetic({"uniform", 20, 1}).cloud, folder.path(name));
    return folder.path(name);
}

void put_colmap(const test::Folder& folder, const std::string& model, const std::string& name) {
    folder.write(model + "/cameras.bin", test::colmap_cameras({test::ColmapLens{}}));
    test::ColmapImage image;
    image.name = name;
    folder.write(model + "/images.bin", test::colmap_images({image}));
}

TEST(CameraFiles, AreKnownByTheirContent) {
    const test::Folder folder;
    EXPECT_EQ(test::read_cameras_of(folder.write("a.txt", std::string("\n \t") + kCamerasOfOne))
                  .at(0)
                  .name,
              "j");
    EXPECT_EQ(test::read_cameras_of(folder.write("cameras.json", kTransformsOfOne)).at(0).name,
              "t");
    EXPECT_EQ(test::read_cameras_of(
                  folder.write("b.json", std::string("\xef\xbb\xbf") + kTransformsOfOne))
                  .at(0)
                  .name,
              "t");
}

TEST(CameraFiles, BesideAScene) {
    const test::Folder folder;
    const std::string scene = put_scene(folder, "scene.ply");
    EXPECT_EQ(cameras_beside(scene), "");
    put_colmap(folder, "sparse/0", "c");
    EXPECT_EQ(load_scene(scene).cameras.at(0).name, "c");
    EXPECT_EQ(camera_count(scene), 1U);
    folder.write("transforms.json", kTransformsOfOne);
    EXPECT_EQ(load_scene(scene).cameras.at(0).name, "t");
    folder.write("cameras.json", kCamerasOfOne);
    EXPECT_EQ(load_scene(scene).cameras.at(0).name, "j");
    std::string own = kCamerasOfOne;
    own.replace(own.find("\"j\""), 3, "\"own\"");
    folder.write("scene.cameras.json", own);
    EXPECT_EQ(load_scene(scene).cameras.at(0).name, "own");
    EXPECT_EQ(load_scene(put_scene(folder, "other.ply")).cameras.at(0).name, "j");
    // The folder of the data set, as --camera-file.
    EXPECT_EQ(load_scene(scene, folder.path("sparse")).cameras.at(0).name, "c");
}

TEST(CameraFiles, BesideAModelOfTheTrainingCode) {
    const test::Folder folder;
    const std::string scene = put_scene(folder, "m/point_cloud/iteration_7/point_cloud.ply");
    put_colmap(folder, "m/sparse/0", "c");
    EXPECT_EQ(load_scene(scene).cameras.at(0).name, "c");
    put_colmap(folder, "m/point_cloud/iteration_7/sparse/0", "nearer");
    EXPECT_EQ(load_scene(scene).cameras.at(0).name, "nearer");
}

TEST(CameraFiles, NotesReachTheScene) {
    const test::Folder folder;
    const std::string scene = put_scene(folder, "scene.ply");
    std::string text = kTransformsOfOne;
    folder.write("transforms.json", text.insert(1, R"("k1":-5,)"));
    ASSERT_EQ(load_scene(scene).notes.size(), 1U);
    EXPECT_THAT(load_scene(scene).notes[0], test::IsSentenceWith("folds back"));
}

TEST(CameraFiles, AllThatTheyAreMadeOfIsListed) {
    const test::Folder folder;
    put_colmap(folder, "d/sparse/0", "c");
    const std::vector<std::string> both{folder.path("d/sparse/0/cameras.bin"),
                                        folder.path("d/sparse/0/images.bin")};
    EXPECT_EQ(files_of_cameras(folder.path("d")), both);
    EXPECT_EQ(files_of_cameras(folder.path("d/sparse/0")), both);
    EXPECT_EQ(files_of_cameras(both[0]).size(), 3U); // itself, and both
    EXPECT_EQ(files_of_cameras("").size(), 1U);
}

} // namespace
} // namespace degs
