// SPDX-License-Identifier: Apache-2.0
// Scenes that are written into one folder keep their own cameras, and a generated view is nobody's.
#include <algorithm>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// Two Gaussians around (x, 0, 0), so that views of scenes far apart show nothing of each other.
void write_scene_at(const std::string& file, float x) {
    fs::create_directories(fs::path(file).parent_path());
    Splat left, right;
    left.mean = {x - 0.5F, 0, 0};
    right.mean = {x + 0.5F, 0.2F, 0};
    write_ply(file, {left, right});
}

nlohmann::json info_of(const std::string& scene) {
    const Outcome info = degs({"scene", "info", scene, "--json", "--camera", "0"});
    EXPECT_EQ(info.code, 0) << info.err;
    return nlohmann::json::parse(info.out);
}

std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

using Names = std::vector<std::string>;

class GeneratedView : public ::testing::TestWithParam<const char*> {};

TEST_P(GeneratedView, IsNoCameraOfAFolder) {
    const Folder folder;
    write_scene_at(folder / "in/room.ply", 0);
    write_scene_at(folder / "in/cup.ply", 1000);
    const std::string extension = GetParam();
    for (const char* const name : {"room", "cup"}) {
        const std::string stem = name;
        const Outcome made = degs({"scene", "convert", folder / ("in/" + stem + ".ply"), "--out",
                                   folder / ("out/" + stem + extension)});
        expect_success(made, "the generated view is at");
        EXPECT_NE(made.out.find("has no cameras"), std::string::npos) << made.out;
    }
    EXPECT_EQ(names_in(folder / "out"), (Names{"cup" + extension, "room" + extension}));
    for (const char* const name : {"room", "cup"}) {
        const std::string file = folder / ("out/" + (name + extension));
        expect_success(degs({"scene", "info", file}), "the generated view is at");
        EXPECT_EQ(info_of(file)["view"]["visible"], 2) << file;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, GeneratedView, ::testing::Values(".spz", ".ply", ".glb"));

TEST(OwnCameras, StayWithTheirScene) {
    const Folder folder;
    expect_success(degs(
        {"scene", "generate", "object", "--gaussians", "200", "--out", folder / "out/object.ply"}));
    expect_success(degs({"scene", "generate", "outdoor", "--gaussians", "200", "--out",
                         folder / "out/outdoor.spz"}));
    write_scene_at(folder / "in/cup.ply", 1000);
    expect_success(
        degs({"scene", "convert", folder / "in/cup.ply", "--out", folder / "out/cup.glb"}),
        "the generated view is at");
    EXPECT_EQ(names_in(folder / "out"), (Names{"cup.glb", "object.cameras.json", "object.ply",
                                               "outdoor.cameras.json", "outdoor.spz"}));
    EXPECT_EQ(info_of(folder / "out/cup.glb")["view"]["visible"], 2);
    for (const char* const name : {"object.ply", "outdoor.spz"}) {
        const std::string spec = "synthetic:" + fs::path(name).stem().string() + ",gaussians=200";
        EXPECT_EQ(info_of(folder / (std::string("out/") + name))["cameras"],
                  info_of(spec)["cameras"]);
    }
}

// As people type it.
TEST(SceneConvert, TakesTheOutputBehindTheInput) {
    const Folder folder;
    write_scene_at(folder / "a.ply", 0);
    for (const char* const output : {"b.spz", "c.glb", "out/d.ply"}) {
        expect_success(degs({"scene", "convert", folder / "a.ply", folder / output}),
                       "the generated view is at");
        EXPECT_TRUE(fs::exists(folder / output)) << output;
    }
    const Outcome both =
        degs({"scene", "convert", folder / "a.ply", folder / "e.ply", "--out", folder / "f.ply"});
    EXPECT_NE(both.code, 0);
    EXPECT_FALSE(fs::exists(folder / "e.ply"));
    EXPECT_NE(degs({"scene", "convert", folder / "a.ply"}).code, 0);
}

TEST(OwnCameras, AreReplacedWithTheirScene) {
    const Folder folder;
    const auto generate = [&folder](const char* profile, const std::string& file) {
        return degs(
            {"scene", "generate", profile, "--gaussians", "50", "--out", folder / ("out/" + file)});
    };
    expect_success(generate("object", "s.ply"));
    expect_success(generate("uniform", "s.ply"));
    EXPECT_EQ(info_of(folder / "out/s.ply")["cameras"],
              info_of("synthetic:uniform,gaussians=50")["cameras"]);
    // The scene keeps its cameras in another format; another scene would lose its own.
    expect_success(degs({"scene", "convert", folder / "out/s.ply", "--out", folder / "out/s.glb"}));
    expect_mistake(generate("outdoor", "s.glb"), "s.ply' is drawn as well");
    write_scene_at(folder / "in/cup.ply", 1000);
    const std::string before = read_file(folder / "out/s.ply");
    const Outcome none =
        degs({"scene", "convert", folder / "in/cup.ply", "--out", folder / "out/s.ply"});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("and the scene has none; remove that file"), std::string::npos)
        << none.err;
    EXPECT_EQ(read_file(folder / "out/s.ply"), before);
}

TEST(SceneCameras, MarkAGeneratedView) {
    const Folder folder;
    write_scene_at(folder / "in/cup.ply", 3);
    const std::string list = folder / "views.json";
    const Outcome told = degs({"scene", "cameras", folder / "in/cup.ply", "--out", list});
    expect_success(told, "the generated view is at");
    EXPECT_NE(told.out.find("orbit (generated)"), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("1 generated view(s)"), std::string::npos) << told.out;
    EXPECT_EQ(nlohmann::json::parse(read_file(list)).at(0).at("generated"), true);
    EXPECT_EQ(info_of(folder / "in/cup.ply")["cameras"][0]["generated"], true);
    expect_success(degs({"scene", "info", folder / "in/cup.ply", "--camera-file", list}),
                   "was generated for a scene that has no cameras");
    // The mark goes along, so that no later command takes the view for one of the scene.
    const std::string copy = folder / "copy.json";
    expect_success(
        degs({"scene", "cameras", folder / "in/cup.ply", "--camera-file", list, "--out", copy}),
        "was generated");
    EXPECT_EQ(read_file(copy), read_file(list));
    fs::copy(list, folder / "in/cameras.json");
    expect_success(
        degs({"scene", "convert", folder / "in/cup.ply", "--out", folder / "out/cup.glb"}),
        "was generated");
    EXPECT_EQ(names_in(folder / "out"), (Names{"cup.glb"}));
    const Outcome own = degs({"scene", "cameras", "synthetic:uniform,gaussians=50", "--out", list});
    expect_success(own);
    EXPECT_EQ(own.out.find("generated"), std::string::npos) << own.out;
    EXPECT_FALSE(nlohmann::json::parse(read_file(list)).at(0).contains("generated"));
}

} // namespace
} // namespace degs::sim_test
