// SPDX-License-Identifier: Apache-2.0
// The commands other than run, as a user calls them.
#include "base/grouped_number.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

class Help : public ::testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Help, ExplainsTheCommandAndSucceeds) {
    std::vector<std::string> arguments = GetParam();
    const std::string command = arguments.empty() ? "degs" : arguments.back();
    arguments.emplace_back("--help");
    const Outcome outcome = degs(arguments);
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("Usage: degs"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(command), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("SystemC 2"), std::string::npos) << "the kernel's banner";
}

using Words = std::vector<std::string>;
INSTANTIATE_TEST_SUITE_P(Commands, Help,
                         ::testing::Values(Words{}, Words{"run"}, Words{"compare"}, Words{"render"},
                                           Words{"scene"}, Words{"scene", "info"},
                                           Words{"scene", "generate"}, Words{"scene", "convert"},
                                           Words{"scene", "tile"}, Words{"memory"}, Words{"soc"},
                                           Words{"config"}, Words{"accuracy"}));

TEST(Version, IsOneLine) {
    const Outcome outcome = degs({"--version"});
    expect_success(outcome);
    EXPECT_EQ(outcome.out.rfind("degs ", 0), 0U);
    EXPECT_EQ(outcome.out.find('\n'), outcome.out.size() - 1);
}

TEST(ConfigCommand, YamlReproducesTheConfiguration) {
    const Folder folder;
    const Outcome first =
        degs({"config", config("degs-256"), "--set", "memory.latency_ns=77", "--format", "yaml"});
    expect_success(first);
    std::ofstream(folder / "c.yaml") << first.out;
    EXPECT_EQ(degs({"config", folder / "c.yaml", "--format", "yaml"}).out, first.out);
    EXPECT_NE(first.out.find("latency_ns: 77"), std::string::npos);
    EXPECT_NE(first.out.find("tile_size: 64"), std::string::npos);
}

TEST(ConfigCommand, ExplainsEveryKeyInEveryFormat) {
    const std::vector<std::pair<const char*, const char*>> ranges{{"text", "1 to 64"},
                                                                  {"markdown", "| 1..64 |"}};
    for (const auto& [format, range] : ranges) {
        const Outcome outcome = degs({"config", "--format", format});
        expect_success(outcome);
        EXPECT_NE(outcome.out.find("scheduler.reuse_cycles"), std::string::npos);
        EXPECT_NE(outcome.out.find(range), std::string::npos);
    }
}

TEST(SceneCommand, GeneratesWhatInfoReads) {
    const Folder folder;
    const std::string file = folder / "made/scene.ply";
    expect_success(
        degs({"scene", "generate", "object", "--gaussians", "500", "--seed", "7", "--out", file}));
    ASSERT_TRUE(fs::exists(folder / "made/scene.cameras.json"));
    const Outcome info = degs({"scene", "info", file, "--camera", "1", "--width", "160"});
    expect_success(info);
    EXPECT_NE(info.out.find("500 Gaussians"), std::string::npos) << info.out;
    EXPECT_NE(info.out.find("per visible splat"), std::string::npos) << info.out;
    // The file stands for the generator: the same view has the same picture.
    for (const std::string& scene : {file, std::string("synthetic:object,gaussians=500,seed=7")}) {
        const std::string out = folder / (scene == file ? "a" : "b");
        expect_success(
            degs({"render", "--scene", scene, "--camera", "1", "--width", "160", "--out", out}));
    }
    EXPECT_EQ(read_file(folder / "a/image.png"), read_file(folder / "b/image.png"));
}

TEST(SceneCommand, KeepsCamerasThatAreThere) {
    const Folder folder;
    write_camera(folder / "cameras.json", {1, 2, 3});
    const std::string before = read_file(folder / "cameras.json");
    expect_success(degs({"scene", "generate", "single", "--out", folder / "scene.ply"}));
    EXPECT_EQ(read_file(folder / "cameras.json"), before);
}

TEST(SceneCommand, ConvertsWithoutTheUndrawable) {
    const Folder folder;
    Splat bad;
    bad.rotation = {0, 0, 0, 0};
    write_ply(folder / "in.ply", {Splat{}, bad});
    write_camera(folder / "cameras.json", {0, 0, -3});
    expect_success(degs({"scene", "convert", folder / "in.ply", "--out", folder / "out.ply"}),
                   "1 of the 2 Gaussians of the file cannot be drawn and were dropped");
    const Outcome info = degs({"scene", "info", folder / "out.ply"});
    EXPECT_NE(info.out.find("1 Gaussian,"), std::string::npos) << info.out;
}

TEST(SceneCommand, ConvertsToGlbAndBack) {
    const Folder folder;
    const std::string ply = folder / "a/scene.ply";
    expect_success(degs({"scene", "generate", "object", "--gaussians", "300", "--out", ply}));
    expect_success(degs({"scene", "convert", ply, "--out", folder / "b/scene.glb"}));
    expect_success(
        degs({"scene", "convert", folder / "b/scene.glb", "--out", folder / "c/scene.ply"}));
    EXPECT_EQ(read_file(folder / "b/scene.cameras.json"),
              read_file(folder / "a/scene.cameras.json"));
    for (const char* const name : {"a/scene.ply", "b/scene.glb"}) {
        expect_success(degs({"scene", "info", folder / name, "--camera", "0", "--width", "160",
                             "--preview", folder / (std::string(name) + ".png")}));
    }
    EXPECT_EQ(read_file(folder / "a/scene.ply.png"), read_file(folder / "b/scene.glb.png"));
    const Outcome wrong = degs({"scene", "convert", ply, "--out", folder / "scene.obj"});
    EXPECT_NE(wrong.code, 0);
    EXPECT_NE(wrong.err.find("must end in one of .ply, .spz, .glb"), std::string::npos)
        << wrong.err;
}

TEST(SceneCommand, TilesAScene) {
    const Folder folder;
    const std::string file = folder / "tiled.glb";
    const std::string scene = "synthetic:object,gaussians=300";
    const Outcome tiled = degs({"scene", "tile", scene, "--copies", "3x2x2", "--out", file});
    expect_success(tiled);
    EXPECT_NE(tiled.out.find(grouped(3600)), std::string::npos) << tiled.out;
    const Outcome info = degs({"scene", "info", file, "--json", "--camera", "0"});
    expect_success(info);
    const auto told = nlohmann::json::parse(info.out);
    EXPECT_EQ(told["scene"]["gaussians"], 3600);
    EXPECT_EQ(told["cameras"].size(), 3U);
    EXPECT_EQ(told["cameras"][2]["width"], 1920);
    EXPECT_GT(told["view"]["visible"], 3000);
    expect_success(degs({"scene", "tile", scene, "--gaussians", "1000", "--out", file}));
    EXPECT_EQ(
        nlohmann::json::parse(degs({"scene", "info", file, "--json"}).out)["scene"]["gaussians"],
        1200);
    EXPECT_NE(degs({"scene", "tile", scene, "--out", file}).err.find("needs --copies"),
              std::string::npos);
    EXPECT_NE(degs({"scene", "tile", scene, "--copies", "2x2", "--out", folder / "a.ply"})
                  .err.find("only .glb can"),
              std::string::npos);
}

TEST(RenderCommand, CountsDoNotDependOnTheTileSize) {
    const Folder folder;
    std::vector<nlohmann::json> counts;
    for (const char* size : {"16", "50"}) {
        expect_success(degs({"render", "--scene", "synthetic:object,gaussians=500", "--width",
                             "160", "--tile-size", size, "--out", folder / "out"}));
        counts.push_back(nlohmann::json::parse(read_file(folder / "out/render.json")));
    }
    EXPECT_GT(counts[0]["workload"]["fragments"], 0);
    EXPECT_EQ(counts[0]["workload"]["fragments"], counts[1]["workload"]["fragments"]);
    EXPECT_NE(counts[0]["workload"]["tiles"], counts[1]["workload"]["tiles"]);
    EXPECT_GT(counts[0]["host"]["render_s"], 0);
    EXPECT_TRUE(fs::exists(folder / "out/image.exr"));
}

} // namespace
} // namespace degs::sim_test
