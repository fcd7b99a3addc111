// SPDX-License-Identifier: Apache-2.0
// degs accuracy, as a user calls it.
#include <cmath>
#include <map>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

json accuracy_of_gaussians(const Folder& folder, std::vector<std::string> arguments) {
    std::vector<std::string> all{"accuracy", "--single-gaussian", "--out", folder / "out"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = degs(all);
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("isotropic-3"), std::string::npos) << outcome.out;
    return json::parse(read_file(folder / "out/accuracy.json"));
}

TEST(AccuracyCommand, WritesARowPerKindAndSet) {
    const Folder folder;
    const json rows = accuracy_of_gaussians(folder, {"--numbers", "paper,tuned", "--splats", "40"});
    ASSERT_EQ(rows.size(), 6U);
    const std::vector<std::string> numbers{"fp16-direct", "paper", "tuned"};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const json& row = rows[i];
        EXPECT_EQ(row["scene"], i < 3 ? "isotropic-3" : "random");
        EXPECT_EQ(row["numbers"], numbers[i % 3]);
        EXPECT_EQ(row["resolution"], "32x32");
        for (const char* none : {"camera", "psnr_db", "ssim", "flip", "max_abs_error"}) {
            EXPECT_TRUE(row.at(none).is_null()) << none;
        }
        EXPECT_EQ(row["nonfinite"], 0);
        EXPECT_EQ(row["gaussians"], 40);
        EXPECT_GT(row["alpha_error_mean"], 0);
        EXPECT_GT(row["alpha_error_spread"], 0);
        EXPECT_GE(row["alpha_error_max"], row["alpha_error_mean"]);
        EXPECT_EQ(row["alpha_error_mean_to_fp16"].is_null(), i % 3 == 0);
    }
}

TEST(AccuracyCommand, DependsOnItsSeedAndOnNothingElse) {
    const Folder folder;
    const json one =
        accuracy_of_gaussians(folder, {"--numbers", "tuned", "--splats", "20", "--seed", "5"});
    EXPECT_EQ(
        accuracy_of_gaussians(folder, {"--numbers", "tuned", "--splats", "20", "--seed", "5"}),
        one);
    EXPECT_NE(
        accuracy_of_gaussians(folder, {"--numbers", "tuned", "--splats", "20", "--seed", "6"}),
        one);
    // The Gaussians do not depend on which sets look at them.
    const json both =
        accuracy_of_gaussians(folder, {"--numbers", "fp32,tuned", "--splats", "20", "--seed", "5"});
    EXPECT_EQ(both[2], one[1]);
}

TEST(AccuracyCommand, ProjectsScenes) {
    const Folder folder;
    const json rows = accuracy_of_gaussians(folder, {"--numbers", "ideal", "--splats", "30",
                                                     "--scene", "synthetic:object,gaussians=500",
                                                     "--camera", "1", "--resolution", "720p"});
    ASSERT_EQ(rows.size(), 6U);
    EXPECT_EQ(rows[5]["camera"], 1);
    EXPECT_EQ(rows[5]["resolution"], "1280x720");
    EXPECT_LT(rows[5]["alpha_error_mean"], 1e-12);
    EXPECT_GT(rows[4]["alpha_error_mean"], 1e-6); // fp16-direct
}

TEST(AccuracyCommand, NamesMistakes) {
    const Folder folder;
    const std::string out = folder / "out";
    expect_mistake(degs({"accuracy", "--single-gaussian", "--numbers", "fp8", "--out", out}),
                   "'fp8'");
    expect_mistake(degs({"accuracy", "--out", out}), "--single-gaussian");
    expect_mistake(degs({"accuracy", "--single-gaussian", "--splats", "0", "--out", out}),
                   "--splats");
    expect_mistake(degs({"accuracy", "--single-gaussian", "--scene", "absent.ply", "--splats", "1",
                         "--out", out}),
                   "absent.ply");
}

// Real Gaussians, projected: what `tuned` must keep (mean, largest away from flips, flips).
TEST(AccuracyCommand, TunedMeetsItsTargetsOnTrainedScenes) {
    const fs::path scenes = trained_scenes();
    if (!fs::exists(scenes / "seal")) {
        GTEST_SKIP() << "This test needs " << scenes << "; set DEGS_SCENES";
    }
    const Folder folder;
    std::vector<std::string> arguments{"--numbers", "tuned", "--splats",     "1000",
                                       "--camera",  "2",     "--resolution", "8k"};
    for (const char* scene : {"seal", "skull", "flowers", "st-peter"}) {
        arguments.insert(arguments.end(), {"--scene", (scenes / scene / "scene.ply").string()});
    }
    const json rows = accuracy_of_gaussians(folder, arguments);
    ASSERT_EQ(rows.size(), 12U);
    for (std::size_t i = 5; i < rows.size(); i += 2) {
        const json& row = rows[i];
        EXPECT_EQ(row["numbers"], "tuned");
        EXPECT_LE(row["alpha_error_mean"], 5e-5) << row;
        EXPECT_LE(row["alpha_error_max"], 1e-3) << row;
        EXPECT_LE(row["flips"].get<double>(), 5e-4 * row["support_pixels"].get<double>()) << row;
        EXPECT_GT(row["support_pixels"], 10000) << row;
    }
}

} // namespace
} // namespace degs::sim_test
