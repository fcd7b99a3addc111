// SPDX-License-Identifier: Apache-2.0
// The near plane has a key, and says when it removes what the view would show.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// One Gaussian at each distance in front of the camera, and one beside the view.
std::string write_near_scene(const Folder& folder, std::initializer_list<float> depths) {
    fs::create_directories(folder / "in");
    std::vector<Splat> splats;
    for (const float z : depths) {
        Splat splat;
        splat.mean = {0, 0, z};
        splats.push_back(splat);
    }
    Splat beside;
    beside.mean = {5, 0, 0.1F};
    splats.push_back(beside);
    write_ply(folder / "in/s.ply", splats);
    std::ofstream(folder / "in/cameras.json")
        << R"([{"width": 64, "height": 48, "fx": 60, "fy": 60, "position": [0, 0, 0],
              "rotation": [[1,0,0],[0,1,0],[0,0,1]]}])";
    return folder / "in/s.ply";
}

TEST(NearPlane, SaysWhatItRemovesInEveryCommandThatDraws) {
    const Folder folder;
    const std::string scene = write_near_scene(folder, {0.05F, 0.1F, 0.19F, 1, 2});
    const std::string words = "removes 3 of 6 Gaussians";
    const std::string out = folder / "out";
    const std::string design = config("degs-16");
    expect_success(degs({"render", "--scene", scene, "--out", out}), words);
    expect_success(degs({"run", design, "--scene", scene, "--out", out}), words);
    expect_success(degs({"scene", "info", scene, "--camera", "0"}), words);
    expect_success(degs({"render", "--scene", scene, "--near", "0.01", "--out", out}));
    expect_success(degs({"scene", "info", scene, "--camera", "0", "--near", "0.01"}));
    const Outcome run =
        degs({"run", design, "--scene", scene, "--out", out, "--set", "pipeline.rules.near=0.01"});
    expect_success(run);
    const nlohmann::json report = nlohmann::json::parse(read_file(out + "/report.json"));
    EXPECT_EQ(report.at("workload").at("culled").at("near_in_view"), 0);
    EXPECT_EQ(report.at("workload").at("near"), 0.01);
}

TEST(NearPlane, SaysWhatItRemovesInCommandsOfSeveralRuns) {
    const Folder folder;
    const std::string scene = write_near_scene(folder, {0.05F, 0.1F, 0.19F, 1, 2});
    const std::string words = "removes 3 of 6 Gaussians";
    const std::string design = config("degs-16");
    const std::string study = folder / "study.yaml";
    std::ofstream(study) << "study: s\ndesigns:\n  - include: " << design
                         << "\n    name: d\nscenes: " << scene << "\n";
    const std::string nearer = "pipeline.rules.near=0.01";
    const auto warns = [&](std::vector<std::string> command, const std::vector<std::string>& more) {
        command.insert(command.end(), {"--out", folder / "o"});
        const std::string& name = command.front();
        const Outcome outcome = degs(command);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << name << ": " << outcome.err;
        command.insert(command.end(), more.begin(), more.end());
        const Outcome silent = degs(command);
        EXPECT_EQ(silent.code, 0) << silent.err;
        EXPECT_EQ(silent.err.find("near plane"), std::string::npos) << name << ": " << silent.err;
        fs::remove_all(folder / "o");
    };
    warns({"compare", design, "--scene", scene}, {"--set", nearer});
    warns({"sweep", study}, {"--set", nearer});
    warns({"explore", study}, {"--set", nearer});
    warns({"soc", design, "--scene", scene, "--load", "0"}, {"--set", nearer});
    warns({"accuracy", "--scene", scene, "--numbers", "fp16", "--no-error-images"},
          {"--near", "0.01"});
    warns(
        {"accuracy", "--scene", scene, "--single-gaussian", "--numbers", "fp16", "--splats", "10"},
        {"--near", "0.01"});
}

TEST(NearPlane, OfOtherDesignsIsPartOfAPointOnAPath) {
    const Folder folder;
    const std::string scene = write_near_scene(folder, {0.05F, 0.1F, 0.19F, 1, 2});
    const auto cycles = [&](const std::string& values, const std::string& out) {
        std::ofstream(folder / "study.yaml")
            << "designs:\n  - include: " << config("degs-16")
            << "\n    name: d\naxes:\n  pipeline.rules.near: " << values << "\nscenes: " << scene
            << "\nframes: 3\npath_step: 20\n";
        EXPECT_EQ(degs({"sweep", folder / "study.yaml", "--out", folder / out}).code, 0);
        return read_file(folder / (out + "/results.csv"));
    };
    cycles("[0.2]", "o"); // the path turns about what this design sees
    EXPECT_EQ(cycles("[0.01, 0.2]", "o"), cycles("[0.01, 0.2]", "new"));
}

TEST(NearPlane, IsSilentWhereItRemovesNothingInView) {
    const Folder folder;
    expect_success(
        degs({"render", "--scene", write_near_scene(folder, {-1, 1, 2}), "--out", folder / "out"}));
}

TEST(NearPlane, RefusesWhatIsNoDistance) {
    const Folder folder;
    const std::string scene = write_near_scene(folder, {1});
    for (const char* const wrong : {"-1", "nan", "inf", "near"}) {
        EXPECT_NE(degs({"render", "--scene", scene, "--near", wrong, "--out", folder / "o"}).code,
                  0)
            << wrong;
    }
}

} // namespace
} // namespace degs::sim_test
