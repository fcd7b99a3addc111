// SPDX-License-Identifier: Apache-2.0
// degs run --workload: the results of a packed view are those of its scene.
#include <algorithm>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// The paths of all designs that are shipped.
Words shipped_designs() {
    Words designs;
    for (const auto& file : fs::directory_iterator(DEGS_CONFIGS)) {
        if (file.path().extension() == ".yaml") {
            designs.push_back(file.path().string());
        }
    }
    std::sort(designs.begin(), designs.end());
    return designs;
}

struct Results {
    json report;
    std::string image;
};

/// What a run leaves, without the section that differs between runs.
Results results_of(const std::string& design, const Words& options) {
    const Folder folder;
    const Words start{"run", design, "--no-cache", "--out", folder / "out"};
    expect_success(degs(with(start, options)));
    Results results{json::parse(read_file(folder / "out/report.json")),
                    read_file(folder / "out/image.exr")};
    results.report.erase("host");
    return results;
}

/// The report of the packed view names its file and the checksum; everything else is that of the
/// scene.
void expect_equal(const Results& of_scene, Results of_file, const std::string& file) {
    json& scene = of_file.report["scene"];
    EXPECT_EQ(scene["source"], file);
    std::string checksum;
    const std::string bytes = read_file(file);
    for (const char byte : bytes.substr(bytes.size() - 16)) {
        std::array<char, 3> digits{};
        std::snprintf(digits.data(), digits.size(), "%02x", static_cast<unsigned char>(byte));
        checksum += digits.data();
    }
    EXPECT_EQ(scene["workload_xxh128"], checksum);
    scene.erase("workload_xxh128");
    scene["source"] = of_scene.report["scene"]["source"];
    EXPECT_EQ(of_file.report.dump(), of_scene.report.dump());
    EXPECT_TRUE(of_file.image == of_scene.image);
}

TEST(LongPackedFrame, GivesEveryDesignTheReportOfItsScene) {
    const Words view{"--scene",  "synthetic:outdoor,gaussians=1000",
                     "--width",  "64",
                     "--height", "48",
                     "--camera", "1"};
    const Folder folder;
    const Words designs = shipped_designs();
    EXPECT_EQ(designs.size(), 27U);
    const std::string file = folder / "frame.degsw";
    const Words start{"workload", "pack", "--out", file};
    expect_success(degs(with(with(start, designs), view)));
    for (const std::string& design : designs) {
        SCOPED_TRACE(design);
        expect_equal(results_of(design, view), results_of(design, {"--workload", file}), file);
    }
}

TEST(PackedFrame, HoldsEveryNumberSetAndRule) {
    const Folder folder;
    const std::string file = folder / "frame.degsw";
    const Words view{"--scene", "synthetic:outdoor,gaussians=2000", "--width", "64"};
    const std::vector<Words> changes{{"pipeline.numbers=fp64"},
                                     {"pipeline.numbers=fp32"},
                                     {"pipeline.numbers=paper"},
                                     {"pipeline.numbers=tuned"},
                                     {"pipeline.numbers=paper:projection=fp64"},
                                     {"pipeline.numbers=paper:projection=fp16"},
                                     {"pipeline.numbers=paper:gaussian_mean=fp16"},
                                     {"pipeline.rules.preset=khr"},
                                     {"pipeline.rules.near=1"},
                                     {"pipeline.tiles=box"},
                                     {"tile_size=16"}};
    Words pack = with({"workload", "pack", "--out", file}, view), sets;
    for (std::size_t k = 0; k < changes.size(); ++k) {
        const std::string name = "d" + std::to_string(k);
        pack.push_back(name + "=" + config("degs-64"));
        sets.push_back("--set");
        sets.push_back(name + ":" + changes[k].front());
    }
    pack = with(pack, sets);
    expect_success(degs(pack));
    for (const Words& change : changes) {
        SCOPED_TRACE(change.front());
        const Words set{"--set", change.front()};
        expect_equal(results_of(config("degs-64"), with(view, set)),
                     results_of(config("degs-64"), with({"--workload", file}, set)), file);
    }
}

/// A small file for one design.
std::string packed_for(const std::string& design, const Folder& folder) {
    const std::string file = folder / "frame.degsw";
    expect_success(degs({"workload", "pack", config(design), "--scene", "synthetic:single",
                         "--width", "48", "--out", file}));
    return file;
}

TEST(HostilePackedFrame, RefusesOptionsAndDesignsThatItDoesNotHold) {
    const Folder folder;
    const std::string file = packed_for("degs-64", folder);
    const Words run{"run", config("degs-64"), "--workload", file, "--out", folder / "out"};
    for (const char* option : {"--camera", "--width", "--height"}) {
        expect_mistake(degs(with(run, {option, "1"})), option);
    }
    expect_mistake(degs(with(run, {"--scene", "synthetic:single"})), "--scene");
    expect_mistake(degs(with(run, {"--camera-file", "cameras.json"})), "--camera-file");
    expect_mistake(degs(with(run, {"--resolution", "4k"})), "--resolution");
    expect_mistake(degs(with(run, {"--frames", "2"})), "only 1 frame is allowed");
    expect_mistake(degs({"run", config("degs-64"), "--out", folder / "out"}),
                   "needs --scene or --workload.");
    expect_mistake(degs({"run", config("degs-64"), "--workload", ""}), "empty name");
    expect_mistake(degs({"run", config("degs-256"), "--workload", file, "--out", folder / "out"}),
                   "needs a frame of 64 px tiles (box), fp32, which the workload does not hold; "
                   "it holds frames of 32 px tiles (box), fp32.");
    expect_mistake(degs(with(run, {"--what-if", "tile_size=16"})), "16 px tiles");
    expect_mistake(degs({"run", config("degs-64"), "--workload", file + "x"}), "frame.degswx");
    expect_mistake(degs({"run", config("degs-64"), "--workload", config("degs-64")}),
                   "a workload begins with 'degswork'");
}

TEST(HostilePackedFrame, WithoutTheReferenceNeedsARunWithoutIt) {
    const Folder folder;
    const std::string whole = packed_for("degs-64", folder), file = folder / "small.degsw";
    expect_success(degs({"workload", "pack", config("degs-64"), "--scene", "synthetic:single",
                         "--width", "48", "--no-reference", "--out", file}));
    EXPECT_LT(fs::file_size(file), fs::file_size(whole));
    const Words run{"run", config("degs-64"), "--workload", file, "--out", folder / "out"};
    expect_mistake(degs(run), "--no-reference is needed here, too");
    expect_success(degs(with(run, {"--no-reference"})));
}

TEST(HostilePackedFrame, AnEstimateAndAnExportTakeTheFile) {
    const Folder folder;
    const std::string file = packed_for("degs-64", folder);
    expect_success(degs({"run", config("degs-64"), "--workload", file, "--fidelity", "analytic",
                         "--out", folder / "estimate"}));
    const json estimate = json::parse(read_file(folder / "estimate/analytic.json"));
    EXPECT_TRUE(estimate["scene"].contains("workload_xxh128"));
    expect_success(degs(
        {"workload", "export", config("degs-64"), "--workload", file, "--out", folder / "lists"}));
    const json lists = json::parse(read_file(folder / "lists/workload.json"));
    EXPECT_EQ(lists["splats"], 1);
}

TEST(HostilePackedFrame, IsNotWrittenOverItsScene) {
    const Folder folder;
    const std::string scene = folder / "scene.ply";
    write_ply(scene, {Splat{}});
    expect_mistake(degs({"workload", "pack", config("degs-64"), "--scene", scene, "--out", scene}),
                   "scene.ply");
    expect_mistake(degs({"workload", "pack", config("degs-64"), "--scene", scene, "--out",
                         folder / "none/frame.degsw"}),
                   "none");
}

} // namespace
} // namespace degs::sim_test
