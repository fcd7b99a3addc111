// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.hpp"

#include "scene/ply/ply.hpp"
#include "scene/scene_formats.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::complaint;
using test::Folder;
using test::IsSentenceWith;

/// A folder with small scenes in it.
struct SceneFolder : Folder {
    std::string put_scene(const std::string& name) const {
        write(name, "");
        write_ply(make_synthetic({"uniform", 50, 1}).cloud, path(name));
        return path(name);
    }
    std::string put_cameras(const std::string& name, const std::string& camera_name) const {
        return write(name, R"([{"width": 32, "height": 24, "position": [0, 0, -4], "fx": 30,
            "fy": 30, "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "img_name": ")" +
                               camera_name + "\"}]");
    }
};

TEST(SceneLoading, TakesCamerasFromBesideTheFile) {
    const SceneFolder folder;
    const std::string file = folder.put_scene("garden/scene.ply");
    folder.put_cameras("garden/cameras.json", "beside");
    const Scene scene = load_scene(file);
    EXPECT_EQ(scene.cloud.size(), 50U);
    EXPECT_EQ(scene.name, "garden");
    EXPECT_EQ(scene.source, file);
    EXPECT_EQ(scene.dropped.total(), 0U);
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(select_camera(scene, 0).name, "beside");
    const std::string other = folder.put_cameras("other.json", "explicit");
    EXPECT_EQ(load_scene(file, other).cameras.at(0).name, "explicit");
}

TEST(SceneLoading, KnowsTheFoldersOfTrainingRuns) {
    const SceneFolder folder;
    const std::string file = folder.put_scene("model/point_cloud/iteration_30000/point_cloud.ply");
    folder.put_cameras("model/cameras.json", "training");
    const Scene scene = load_scene(file);
    EXPECT_EQ(scene.name, "model");
    EXPECT_EQ(scene.cameras.at(0).name, "training");
}

TEST(SceneLoading, InventsAViewWhereThereIsNone) {
    const SceneFolder folder;
    const Scene scene = load_scene(folder.put_scene("Bonsai.PLY")); // extension in any case
    EXPECT_EQ(scene.name, "Bonsai");
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].name, "orbit");
    ASSERT_EQ(scene.notes.size(), 1U);
    EXPECT_THAT(scene.notes[0], IsSentenceWith("sees 50 x 29.4 degrees"));
}

TEST(SceneLoading, MakesSyntheticScenes) {
    const Scene scene = load_scene("synthetic:uniform,gaussians=123,seed=9");
    EXPECT_EQ(scene.name, "uniform");
    EXPECT_EQ(scene.source, "synthetic:uniform,gaussians=123,seed=9");
    EXPECT_EQ(scene.cloud.size(), 123U);
    EXPECT_EQ(scene.cameras.size(), 3U);
    const SceneFolder folder;
    const std::string cameras = folder.put_cameras("c.json", "mine");
    EXPECT_EQ(load_scene("synthetic:single", cameras).cameras.at(0).name, "mine");
}

TEST(HostileScene, EveryMistakeHasItsSentence) {
    const SceneFolder folder;
    folder.put_scene("good.ply");
    folder.write("sub/notes.txt", "x");
    const std::pair<std::string, const char*> cases[] = {
        {folder.path("absent.ply"), "there is no such file"},
        {folder.path("absent.xyz"), "there is no such file"},
        {folder.path("sub"), "this is a folder without scene files"},
        {folder.write("empty.ply", ""), "the file is empty"},
        {folder.write("scene.obj", "x"), "the extension '.obj' is not that of a scene file"},
        {folder.write("scene", "x"), "the extension ''"},
        {folder.path("good.ply") + "/scene.ply", "."},
        {"/dev/null", "pipe, socket or device"},
        {"", "there is no such file"},
        {"synthetic:", "There is no synthetic scene ''"},
        {"synthetic:moon",
         "there are object, outdoor, landscape, lighthouse, interior, garden, dense, uniform, "
         "single, needles"},
        {"synthetic:object,gaussians=0", "allowed are integers from 1 to"},
        {"synthetic:object,gaussians=99999999999", "allowed are integers from 1 to"},
        {"synthetic:object,gaussians=1e5", "Key 'gaussians'"},
        {"synthetic:object,gaussians", "Key 'gaussians'"},
        {"synthetic:object,seed=-1", "Key 'seed'"},
        {"synthetic:object,seed=18446744073709551616", "Key 'seed'"},
        {"synthetic:object,color=red", "'color=red' is no setting"},
        {"synthetic:object,", "'' is no setting"},
        {"synthetic:single,gaussians=2", "from 1 to 1"},
    };
    for (const auto& [spec, sentence] : cases) {
        EXPECT_THAT(complaint([&, &path = spec] { load_scene(path); }), IsSentenceWith(sentence));
    }
    for (const std::string& extension : scene_extensions()) {
        EXPECT_THAT(complaint([&] { load_scene(folder.path("scene.obj")); }),
                    IsSentenceWith(extension));
    }
}

TEST(HostileScene, BadCamerasAreNotReplacedByGuesses) {
    const SceneFolder folder;
    const std::string file = folder.put_scene("scene.ply");
    EXPECT_THAT(complaint([&] { load_scene(file, folder.path("none.json")); }),
                IsSentenceWith("none.json: there is no such file"));
    folder.write("cameras.json", "[]");
    EXPECT_THAT(complaint([&] { load_scene(file); }), IsSentenceWith("holds no camera"));
}

TEST(SceneCameras, AreSelectedByNumber) {
    const Scene scene = load_scene("synthetic:single");
    EXPECT_EQ(select_camera(scene, 2).name, "closeup");
    for (const int index : {-1, 3, 1000000}) {
        EXPECT_THAT(complaint([&] { select_camera(scene, index); }),
                    IsSentenceWith("has 3 camera(s), numbered from 0"));
    }
}

} // namespace
} // namespace degs
