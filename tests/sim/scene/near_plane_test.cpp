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
