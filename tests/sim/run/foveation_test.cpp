// SPDX-License-Identifier: Apache-2.0
// Foveated frames through the program: images, reports and refusals.
#include <filesystem>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

std::vector<std::string> foveated_run(const std::string& design, const std::string& out,
                                      const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",      config(design),
                                       "--scene",  "synthetic:object,gaussians=2000",
                                       "--width",  "161",
                                       "--height", "99",
                                       "--out",    out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

json foveated_report(const std::string& design, const std::vector<std::string>& more) {
    const Folder folder;
    expect_success(degs(foveated_run(design, folder / "out", more)));
    return report_in(folder / "out");
}

class FoveatedRun : public testing::TestWithParam<const char*> {};

TEST_P(FoveatedRun, SaysWhatItDrewAndHowFarItIsFromAFullImage) {
    const json report = foveated_report(GetParam(), {"--foveation", "0.5,0.5:8:16"});
    const json& foveation = report["foveation"];
    EXPECT_EQ(report["camera"]["width"], 161);
    EXPECT_EQ(report["views"]["count"], 3);
    EXPECT_EQ(report["timing"]["frames"], 1);
    EXPECT_EQ(foveation["pixels"], 161 * 99);
    const json& levels = foveation["images"][0]["levels"];
    ASSERT_EQ(levels.size(), 3U);
    std::uint64_t shown = 0, drawn = 0;
    for (const json& level : levels) {
        shown += level["pixels_shown"].get<std::uint64_t>();
        drawn += level["pixels_drawn"].get<std::uint64_t>();
        const int scale = level["scale"];
        EXPECT_GE(level["pixels_drawn"].get<int>(),
                  level["pixels_shown"].get<int>() / (scale * scale));
    }
    EXPECT_EQ(shown, 161U * 99U);
    EXPECT_EQ(foveation["pixels_drawn"], drawn);
    const json exact =
        foveated_report(GetParam(), {"--foveation", "0.5,0.5:8:16", "--fidelity", "strict"});
    EXPECT_EQ(exact["foveation"], foveation);
    EXPECT_EQ(exact["timing"], report["timing"]);
}
INSTANTIATE_TEST_SUITE_P(Designs, FoveatedRun,
                         testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1"));

TEST(FoveatedRuns, OfAFoveaThatIsTheImageArePlainOnes) {
    const json plain = foveated_report("degs-64", {});
    json whole = foveated_report("degs-64", {"--foveation", "0.2,0.9:90:90"});
    EXPECT_FALSE(plain.contains("foveation"));
    EXPECT_EQ(whole["foveation"]["images"][0]["levels"].size(), 1U);
    EXPECT_EQ(whole["foveation"]["images"][0]["crc32"], plain["image"]["crc32"]);
    EXPECT_NEAR(whole["foveation"]["images"][0]["psnr_db"].get<double>(),
                plain["image"]["psnr_db"].get<double>(), 1e-9); // another order of sums
    for (const char* section : {"timing", "energy", "image", "dram", "workload", "camera"}) {
        EXPECT_EQ(whole[section], plain[section]) << section;
    }
}

// In double with exact ends the data path is the reference: what is left is foveation alone.
TEST(FoveatedRuns, AreExactInTheFovea) {
    const json report =
        foveated_report("degs-64", {"--foveation", "0.5,0.5:12:12", "--set",
                                    "pipeline.numbers=fp64", "--set", "pipeline.span_ends=exact"});
    EXPECT_EQ(report["image"]["psnr_db"], "inf");
    const json& levels = report["foveation"]["images"][0]["levels"];
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(levels[0]["psnr_db"], "inf");
    EXPECT_LT(levels[0]["flip"], levels[1]["flip"]); // not 0: its filters see pixels around
    EXPECT_EQ(levels[1]["name"], "periphery");
    EXPECT_TRUE(levels[1]["psnr_db"].is_number());
    EXPECT_GT(levels[1]["flip"].get<double>(), 0);
}

TEST(FoveatedRuns, GoWithEyesFramesAndCrops) {
    const Folder folder;
    expect_success(degs(foveated_run("degs-64", folder / "out",
                                     {"--foveation", "0.5,0.5:8:16", "--eyes", "0.1", "--frames",
                                      "2", "--crop", "10,5,121x80"})));
    const json report = report_in(folder / "out");
    EXPECT_EQ(report["views"]["count"], 6);
    EXPECT_EQ(report["timing"]["frames"], 2);
    EXPECT_EQ(report["foveation"]["images"].size(), 2U);
    EXPECT_EQ(report["foveation"]["pixels"], 2 * 121 * 80);
    EXPECT_TRUE(std::filesystem::exists(folder / "out/image-1.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/image-2.png"));
    const json one = foveated_report(
        "degs-64", {"--foveation", "0.5,0.5:8:16", "--views", "0,2", "--no-reference"});
    EXPECT_EQ(one["views"]["count"], 6);
    EXPECT_TRUE(one["foveation"]["images"][1]["flip"].is_null());
}

TEST(FoveatedRuns, OfOnePixelAreThere) {
    const Folder folder;
    expect_success(
        degs({"run", config("gcc-64"), "--scene", "synthetic:object,gaussians=2000", "--width", "1",
              "--height", "1", "--out", folder / "out", "--foveation", "1,0:0.001:0.002"}));
    const json report = report_in(folder / "out");
    EXPECT_EQ(report["foveation"]["pixels_drawn"], 1);
}

// The second run finds in the cache what the first one made, and one without foveation does not.
TEST(FoveatedRuns, AreTheSameFromTheCache) {
    const Folder folder;
    const std::string cache = folder / "cache";
    const auto with_cache = [&cache] { ::setenv("DEGS_CACHE", cache.c_str(), 1); };
    const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
        expect_success(degs(foveated_run("degs-64", folder / out, more), with_cache));
        json report = report_in(folder / out);
        report.erase("host");
        return report;
    };
    const std::vector<std::string> foveated{"--foveation", "0.5,0.5:8:16"};
    const json first = run("first", foveated), second = run("second", foveated);
    EXPECT_EQ(first, second);
    EXPECT_NE(run("plain", {})["image"]["crc32"], first["image"]["crc32"]);
}

TEST(FoveatedRuns, AreRefusedWhereTheyMeanNothing) {
    const auto refused = [](const std::vector<std::string>& more, const std::string& words) {
        const Folder folder;
        expect_mistake(degs(foveated_run("degs-64", folder / "out", more)), words);
    };
    for (const char* text : {"", "0.5,0.5", "0.5,0.5:10", "0.5,0.5:10:5", "0.5,0.5:0:5",
                             "0.5,0.5:10:91", "-0.1,0.5:10:20", "0.5,1.1:10:20", "nan,0.5:1:2",
                             "0.5,0.5:10:20:30", "0.5,0.5:10:20x", "0.5;0.5:10:20"}) {
        refused({"--foveation", text}, "X,Y:FOVEA:PERIPHERY");
    }
    const std::string good = "0.5,0.5:10:20";
    refused({"--foveation", good, "--fidelity", "analytic"}, "--fidelity analytic");
    refused({"--foveation", good, "--within", "1%"}, "--within");
    refused({"--foveation", good, "--what-if", "span.count=4"}, "--what-if");
    refused({"--foveation", good, "--maps", "maps"}, "--maps");
}

} // namespace
} // namespace degs::sim_test
