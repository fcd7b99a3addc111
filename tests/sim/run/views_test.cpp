// SPDX-License-Identifier: Apache-2.0
// Frames of several views through the program: images, reports and refusals.
#include <filesystem>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

std::vector<std::string> run_of(const std::string& design, const std::string& out,
                                const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "run",     config(design), "--scene", "synthetic:object,gaussians=2000",
        "--width", "160",          "--out",   out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

json report_of(const std::string& design, const std::vector<std::string>& more) {
    const Folder folder;
    expect_success(degs(run_of(design, folder / "out", more)));
    return report_in(folder / "out");
}

class Eyes : public testing::TestWithParam<const char*> {};

TEST_P(Eyes, AtOnePlaceSeeWhatTheCameraSees) {
    const json one = report_of(GetParam(), {});
    const json eyes = report_of(GetParam(), {"--eyes", "0"});
    EXPECT_FALSE(one.contains("views"));
    const json& views = eyes["views"];
    EXPECT_EQ(views["count"], 2);
    EXPECT_EQ(eyes["timing"]["frames"], 1);
    EXPECT_EQ(eyes["timing"]["cycles"], views["per_frame"]["cycles"]);
    EXPECT_EQ(views["per_frame"]["energy_nj"].get<double>(),
              2 * views["per_view"]["energy_nj"].get<double>());
    ASSERT_EQ(views["first_frame"].size(), 2U);
    for (const json& view : views["first_frame"]) {
        for (const char* key : {"psnr_db", "ssim", "max_abs_error", "crc32"}) {
            EXPECT_EQ(view[key], one["image"][key]) << key;
        }
        EXPECT_EQ(view["visible"], one["workload"]["visible"]);
    }
    const std::string scene = one["dram"]["streams"].contains("means") ? "means" : "geometry";
    EXPECT_EQ(eyes["dram"]["streams"][scene]["bytes_read"],
              one["dram"]["streams"][scene]["bytes_read"]);
}
INSTANTIATE_TEST_SUITE_P(Designs, Eyes,
                         testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1"));

TEST(ViewsOfARun, HaveAnImageEach) {
    const Folder folder;
    expect_success(degs(run_of("degs-64", folder / "out", {"--views", "0,1,2"})));
    for (const char* file : {"image.png", "image-1.png", "image-2.exr"}) {
        EXPECT_TRUE(std::filesystem::exists(folder / "out/" + file)) << file;
    }
    const json report = report_in(folder / "out");
    expect_success(degs(run_of("degs-64", folder / "out", {"--eyes", "0.06"})));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/image-1.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/image-2.png")); // of the run before
    EXPECT_EQ(report["views"]["first_frame"].size(), 3U);
    const json alone = report_of("degs-64", {"--camera", "2"});
    for (const char* key : {"crc32", "psnr_db", "max_abs_error"}) {
        EXPECT_EQ(report["views"]["first_frame"][2][key], alone["image"][key]) << key;
    }
}

TEST(ViewsOfARun, ShareColoursWithAnError) {
    const auto psnr = [](const std::string& shared) {
        const json report = report_of("degs-64", {"--eyes", "0.5", "--set", "pipeline.numbers=fp64",
                                                  "--set", "pipeline.span_ends=exact", "--set",
                                                  "projection.shared_by_views=" + shared});
        return report["views"]["first_frame"][1]["psnr_db"];
    };
    EXPECT_EQ(psnr("sh"), "inf");
    EXPECT_TRUE(psnr("colour").is_number());
}

TEST(ViewsOfARun, AreRefusedWhereOneViewIsMeant) {
    const auto refused = [](const std::vector<std::string>& more, const std::string& words) {
        const Folder folder;
        expect_mistake(degs(run_of("degs-64", folder / "out", more)), words);
    };
    refused({"--eyes", "0.06", "--fidelity", "analytic"}, "--fidelity analytic");
    refused({"--eyes", "0.06", "--within", "1%"}, "--within");
    refused({"--eyes", "0.06", "--what-if", "span.count=4"}, "--what-if");
    refused({"--views", "0"}, "2 to 64 positions");
    refused({"--views", "0,x"}, "2 to 64 positions");
    refused({"--views", "0,1", "--eyes", "1"}, "so it cannot be combined with --eyes.");
    refused({"--views", "0,1", "--camera", "1"}, "so it cannot be combined with --camera.");
}

} // namespace
} // namespace degs::sim_test
