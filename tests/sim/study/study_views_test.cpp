// SPDX-License-Identifier: Apache-2.0
// Eyes, views and crops in commands that run several designs: each run is that of `degs run`.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;
using ViewWords = std::vector<std::string>;

const char* const kViewsScene = "synthetic:object,gaussians=300";

Outcome said(ViewWords arguments, const ViewWords& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    Outcome outcome = degs(arguments);
    outcome.err = without_progress(outcome.err);
    return outcome;
}

json document_of(const std::string& file) {
    return json::parse(read_file(file));
}

json report_of_run(const std::string& design, const ViewWords& more) {
    const Folder folder;
    expect_success(said(
        {"run", config(design), "--scene", kViewsScene, "--width", "64", "--out", folder / "r"},
        more));
    return report_in(folder / "r");
}

void expect_run(const json& row, const json& report) {
    EXPECT_EQ(row["cycles"], report["timing"]["cycles"]);
    EXPECT_EQ(row["dram"]["bytes_read"], report["dram"]["bytes_read"]);
    EXPECT_EQ(row["image"]["psnr_db"], report["image"]["psnr_db"]);
}

class ViewsOfDesigns : public testing::TestWithParam<ViewWords> {};

TEST_P(ViewsOfDesigns, AreThoseOfRuns) {
    const Folder folder;
    const std::string shared = "projection.shared_by_views=colour";
    expect_success(said({"compare", config("degs-16"), "colour=" + config("degs-16"),
                         config("gscore-16"), "--set", "colour:" + shared, "--scene", kViewsScene,
                         "--width", "64", "--frames", "3", "--jobs", "2", "--out", folder / "c"},
                        GetParam()));
    const json written = document_of(folder / "c/compare.json");
    ASSERT_EQ(written["runs"].size(), 3U);
    ViewWords colour = GetParam();
    colour.insert(colour.end(), {"--set", shared});
    expect_run(written["runs"][0], report_of_run("degs-16", GetParam()));
    expect_run(written["runs"][1], report_of_run("degs-16", colour));
    expect_run(written["runs"][2], report_of_run("gscore-16", GetParam()));
    ViewWords path = GetParam();
    path.insert(path.end(), {"--frames", "3", "--set", shared});
    const json of_path = report_of_run("degs-16", path);
    EXPECT_EQ(written["runs"][1]["throughput_fps"], of_path["timing"]["throughput_fps"]);
    EXPECT_EQ(written["views"][0]["changes"], of_path["changes"]);
}
INSTANTIATE_TEST_SUITE_P(Options, ViewsOfDesigns,
                         testing::Values(ViewWords{"--eyes", "0.5", "--units-per-metre", "2"},
                                         ViewWords{"--views", "0,2,1"},
                                         ViewWords{"--crop", "17,9,33x20"},
                                         ViewWords{"--crop", "1,2,40x30", "--eyes", "0.1"}));

std::string views_study(const Folder& folder, const std::string& views) {
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "study: s\ndesigns:\n  - include: " << config("degs-16")
                        << "\n    name: a\nscenes: " << kViewsScene << "\nwidth: 64\n"
                        << views;
    return file;
}

TEST(ViewsOfAStudy, AreThoseOfRuns) {
    for (const auto& [views, options] : std::vector<std::pair<std::string, ViewWords>>{
             {"eyes: 0.5\nunits_per_metre: 2\n", {"--eyes", "1"}},
             {"views: [2, 0]\ncrop: 17,9,33x20\n", {"--views", "2,0", "--crop", "17,9,33x20"}}}) {
        const Folder folder;
        const std::string study = views_study(folder, views);
        expect_success(said({"sweep", study, "--out", folder / "s"}, {}));
        const json run = report_of_run("degs-16", options);
        const json results = document_of(folder / "s/results.json");
        expect_run(results["runs"][0], run);
        EXPECT_EQ(results["views"][0]["views_per_frame"], 2);
        expect_success(said({"compare", study, "--out", folder / "c"}, {}));
        expect_run(document_of(folder / "c/compare.json")["runs"][0], run);
    }
}

/// Points of other views are other points in the same folder.
TEST(ViewsOfAStudy, ArePartOfAPoint) {
    const Folder folder;
    const std::string study = views_study(folder, "eyes: 0.5\n");
    const auto cycles = [&](const ViewWords& more) {
        expect_success(said({"sweep", study, "--out", folder / "s"}, more));
        return document_of(folder / "s/results.json")["runs"][0]["cycles"].get<double>();
    };
    EXPECT_EQ(cycles({}), report_of_run("degs-16", {"--eyes", "0.5"})["timing"]["cycles"]);
    EXPECT_EQ(cycles({"--eyes", "2"}),
              report_of_run("degs-16", {"--eyes", "2"})["timing"]["cycles"]);
    EXPECT_EQ(cycles({"--views", "1,2"}),
              report_of_run("degs-16", {"--views", "1,2"})["timing"]["cycles"]);
    EXPECT_EQ(
        cycles({"--crop", "0,0,32x32"}),
        report_of_run("degs-16", {"--eyes", "0.5", "--crop", "0,0,32x32"})["timing"]["cycles"]);
}

TEST(HostileViewsOfAStudy, Mistakes) {
    const auto refused = [](const std::string& views, const ViewWords& more,
                            const std::string& words) {
        const Folder folder;
        expect_mistake(said({"sweep", views_study(folder, views), "--out", folder / "s"}, more),
                       words);
    };
    refused("eyes: -1\n", {}, "'eyes'");
    refused("units_per_metre: 2\n", {}, "'units_per_metre' is for 'eyes'");
    refused("views: [0]\n", {}, "2 to 64 positions");
    refused("views: [0, 1]\neyes: 1\n", {}, "'views' and 'eyes' exclude each other");
    refused("views: [0, 1]\ncameras: 1\n", {}, "'views' and 'cameras' exclude each other");
    refused("views: [0, 9]\n", {}, "Camera 9 does not exist");
    refused("crop: 0,0,32x32\n", {"--resolution", "720p,1080p", "--crop", "0,0,32x32"},
            "images in one size");
    refused("crop: 1,2,3\n", {}, "X,Y,WxH");
    refused("eyes: 1\n", {"--within", "1%"},
            "--eyes (or 'eyes' of a study) gives a frame several views");
    refused("eyes: 1\nfidelity: analytic\n", {},
            "--eyes (or 'eyes' of a study) gives a frame several views");
    const Folder folder;
    const std::string study = views_study(folder, "crop: 0,0,32x32\naxes: {clock_ghz: [0.5, 1]}\n");
    const Outcome searched =
        said({"explore", study, "--goals", "latency_ms", "--out", folder / "e"}, {});
    EXPECT_EQ(searched.code, 0) << searched.err;
}

} // namespace
} // namespace degs::sim_test
