// SPDX-License-Identifier: Apache-2.0
// Broken and malicious input to the whole program: one sentence and a code, or a picture.
#include <limits>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const char* const kSingleScene = "synthetic:single";

Outcome run_scene(const std::string& scene, const Folder& folder,
                  std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"run",   config("degs-64"), "--scene",       scene,
                                       "--out", folder / "result", "--no-reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return degs(arguments);
}

/// The good splat stands in front of the default view; the bad one must be counted and left out.
nlohmann::json run_with_bad_splat(const Splat& bad) {
    const Folder folder;
    write_ply(folder / "scene.ply", {Splat{}, bad, Splat{{0.1F, 0, 0}}});
    expect_success(run_scene(folder / "scene.ply", folder, {"--width", "64"}),
                   "1 of the 3 Gaussians of the file cannot be drawn and were dropped");
    return report_in(folder / "result");
}

TEST(HostileScene, MissingFile) {
    const Folder folder;
    expect_mistake(run_scene(folder / "absent.ply", folder), "absent.ply");
    EXPECT_FALSE(fs::exists(folder / "result"));
}

TEST(HostileScene, EmptyNames) {
    const Folder folder;
    expect_mistake(run_scene("", folder), "empty name");
    expect_mistake(degs({"run", "", "--scene", kSingleScene}), "''");
    expect_mistake(degs({"run", config("degs-64"), "--scene", kSingleScene, "--out", ""}), "''");
}

TEST(HostileScene, TruncatedPly) {
    const Folder folder;
    write_ply(folder / "scene.ply", std::vector<Splat>(10));
    fs::resize_file(folder / "scene.ply", fs::file_size(folder / "scene.ply") - 100);
    expect_mistake(run_scene(folder / "scene.ply", folder), "scene.ply");
    fs::resize_file(folder / "scene.ply", 40);
    expect_mistake(run_scene(folder / "scene.ply", folder), "scene.ply");
}

TEST(HostileScene, EmptyScene) {
    const Folder folder;
    write_ply(folder / "scene.ply", {});
    expect_mistake(run_scene(folder / "scene.ply", folder), "scene.ply");
}

TEST(HostileScene, NothingDrawable) {
    const Folder folder;
    Splat bad;
    bad.mean[0] = std::numeric_limits<float>::quiet_NaN();
    write_ply(folder / "scene.ply", {bad});
    expect_mistake(run_scene(folder / "scene.ply", folder), "NaN");
}

TEST(HostileScene, NanRotationIsDropped) {
    Splat bad;
    bad.rotation[2] = std::numeric_limits<float>::quiet_NaN();
    const nlohmann::json report = run_with_bad_splat(bad);
    EXPECT_EQ(report["workload"]["dropped"], 1);
    EXPECT_EQ(report["scene"]["dropped"]["non_finite"], 1);
    EXPECT_EQ(report["workload"]["gaussians"], 2);
    EXPECT_GT(report["slots"]["useful"], 0);
}

TEST(HostileScene, InfiniteScaleIsDropped) {
    Splat bad;
    bad.scale[1] = 1000; // exp overflows
    EXPECT_EQ(run_with_bad_splat(bad)["workload"]["dropped"], 1);
    bad.scale[1] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(run_with_bad_splat(bad)["workload"]["dropped"], 1);
}

TEST(HostileScene, CameraInsideASplat) {
    const Folder folder;
    Splat around;
    around.scale = {2, 2, 2};
    Splat ahead = around;
    ahead.mean = {0.1F, 0.1F, 0.5F};
    write_ply(folder / "scene.ply", {around, ahead});
    write_camera(folder / "cameras.json", {0, 0, 0});
    expect_success(run_scene(folder / "scene.ply", folder));
    const nlohmann::json report = report_in(folder / "result");
    EXPECT_EQ(report["workload"]["culled"]["near"], 1);
    EXPECT_EQ(report["slots"]["useful"], 64 * 48);
}

TEST(HostileScene, NothingInView) {
    const Folder folder;
    write_ply(folder / "scene.ply", {Splat{{0, 0, -5}}});
    write_camera(folder / "cameras.json", {0, 0, 0});
    expect_success(run_scene(folder / "scene.ply", folder));
    const nlohmann::json report = report_in(folder / "result");
    EXPECT_EQ(report["workload"]["visible"], 0);
    EXPECT_EQ(report["slots"]["total"], 0);
    EXPECT_TRUE(report["slots"]["utilization"].is_null());
    EXPECT_TRUE(report["slots"]["window_first"].is_null());
    EXPECT_GE(report["dram"]["bytes_written"], 64 * 48 * 4);
}

TEST(HostileView, OnePixel) {
    const Folder folder;
    expect_success(run_scene(kSingleScene, folder, {"--width", "1", "--height", "1"}));
    const nlohmann::json report = report_in(folder / "result");
    EXPECT_EQ(report["camera"]["width"], 1);
    EXPECT_EQ(report["camera"]["height"], 1);
    EXPECT_EQ(report["workload"]["tiles"], 1);
}

TEST(HostileView, BadSizes) {
    const Folder folder;
    expect_mistake(run_scene(kSingleScene, folder, {"--width", "0"}), "--width is 0");
    expect_mistake(run_scene(kSingleScene, folder, {"--height", "-4"}), "--height is -4");
    expect_mistake(run_scene(kSingleScene, folder, {"--width", "100000000"}), "35 389 440");
    expect_mistake(run_scene(kSingleScene, folder, {"--width", "1", "--height", "2000000000"}),
                   "35 389 440");
    expect_mistake(run_scene(kSingleScene, folder, {"--width", "99999999999999"}), "--width");
    expect_mistake(run_scene(kSingleScene, folder, {"--width", "wide"}), "--width");
}

TEST(HostileView, SizesAreShownAsTheyWereTyped) {
    const Folder folder;
    expect_mistake(run_scene(kSingleScene, folder, {"--width", "16384", "--height", "16383"}),
                   "16384 x 16383 pixels");
    // PNG libraries hold a million pixels to a side; refused before the run.
    expect_mistake(run_scene(kSingleScene, folder, {"--width", "1", "--height", "1000001"}),
                   "1 x 1000001 pixels cannot be written as PNG");
    EXPECT_FALSE(fs::exists(folder / "result"));
}

TEST(HostileView, BadResolutions) {
    const Folder folder;
    expect_mistake(run_scene(kSingleScene, folder, {"--resolution", "5k"}), "'5k'");
    expect_mistake(run_scene(kSingleScene, folder, {"--resolution", "5k"}),
                   "720p, 1080p, 2k, 4k, 8k");
    expect_mistake(run_scene(kSingleScene, folder, {"--resolution", "4k", "--width", "64"}),
                   "--width");
    expect_mistake(run_scene(kSingleScene, folder, {"--resolution", "4k", "--height", "9"}),
                   "--height");
    expect_mistake(degs({"scene", "info", kSingleScene, "--resolution", "4k"}), "--camera");
}

TEST(HostileView, BadCameras) {
    const Folder folder;
    expect_mistake(run_scene(kSingleScene, folder, {"--camera", "99"}), "Camera 99");
    expect_mistake(run_scene(kSingleScene, folder, {"--camera", "-1"}), "--camera is '-1'");
    expect_mistake(run_scene(kSingleScene, folder, {"--camera-file", folder / "absent.json"}),
                   "absent.json");
    std::ofstream(folder / "broken.json") << R"([{"width": 4)";
    expect_mistake(run_scene(kSingleScene, folder, {"--camera-file", folder / "broken.json"}),
                   "broken.json");
}

TEST(HostileConfig, UnknownKey) {
    const Folder folder;
    std::ofstream(folder / "c.yaml") << "name: x\nscheduler:\n  bank: 8\n";
    const Outcome outcome = degs({"run", folder / "c.yaml", "--scene", kSingleScene});
    expect_mistake(outcome, "c.yaml:3");
    EXPECT_NE(outcome.err.find("scheduler.banks"), std::string::npos) << outcome.err;
}

TEST(HostileConfig, UnknownAccelerator) {
    const Folder folder;
    std::ofstream(folder / "c.yaml") << "accelerator: abacus\n";
    expect_mistake(degs({"run", folder / "c.yaml", "--scene", kSingleScene}), "abacus");
}

TEST(HostileConfig, EmptyName) {
    expect_mistake(degs({"config", ""}), "name");
    expect_mistake(degs({"run", "", "--scene", kSingleScene}), "name");
}

TEST(HostileConfig, UnclosedQuote) {
    const Folder folder;
    std::ofstream(folder / "c.yaml") << "name: \"x\nscheduler:\n  banks: 16\n# the users\"\n";
    expect_mistake(degs({"config", folder / "c.yaml"}), "c.yaml:1");
}

TEST(HostileConfig, MissingFile) {
    const Folder folder;
    expect_mistake(degs({"run", folder / "absent.yaml", "--scene", kSingleScene}), "absent.yaml");
}

TEST(HostileConfig, BadOverrides) {
    const Folder folder;
    expect_mistake(run_scene(kSingleScene, folder, {"--set", "banks"}), "--set");
    expect_mistake(run_scene(kSingleScene, folder, {"--set", "scheduler.bank=8"}),
                   "scheduler.bank");
    expect_mistake(run_scene(kSingleScene, folder, {"--set", "scheduler.banks=eight"}), "1 to 64");
    expect_mistake(run_scene(kSingleScene, folder, {"--set", "scheduler.banks=65"}), "1 to 64");
    // In range, but does not fit together.
    expect_mistake(run_scene(kSingleScene, folder, {"--set", "array.writeback_cycles=9"}),
                   "reuse_cycles");
    expect_mistake(run_scene(kSingleScene, folder, {"--set", "packing.bytes=4096"}),
                   "must be at least ");
}

TEST(HostileOutput, UnwritableFolder) {
    const Folder folder;
    std::ofstream(folder / "file") << "x";
    const std::vector<std::string> head{"run", config("degs-64"), "--scene", kSingleScene, "--out"};
    for (const std::string& out :
         {folder / "file", folder / "file/below", std::string("/proc/x")}) {
        std::vector<std::string> arguments = head;
        arguments.push_back(out);
        expect_mistake(degs(arguments), out);
    }
    EXPECT_EQ(read_file(folder / "file"), "x");
}

TEST(HostileOutput, FolderInPlaceOfAResult) {
    const Folder folder;
    fs::create_directories(folder / "result/report.json");
    expect_mistake(run_scene(kSingleScene, folder), "report.json");
    EXPECT_FALSE(fs::exists(folder / "result/image.exr"));
}

TEST(HostileCommandLine, Mistakes) {
    expect_mistake(degs({}), "subcommand");
    expect_mistake(degs({"fly"}), "'fly'");
    expect_mistake(degs({"scene"}), "subcommand");
    expect_mistake(degs({"scene", "fly"}), "'fly'");
    expect_mistake(degs({"run"}), "required");
    expect_mistake(degs({"run", config("degs-64")}), "--scene");
    expect_mistake(
        degs({"run", config("degs-64"), "--scene", kSingleScene, "--fidelity", "sloppy"}),
        "sloppy");
    expect_mistake(degs({"run", config("degs-64"), "--scene", kSingleScene, "--frames", "-2"}),
                   "--frames");
    expect_mistake(degs({"render", "--scene", kSingleScene, "--tiles", "round"}), "round");
    expect_mistake(degs({"render", "--scene", kSingleScene, "--tile-size", "0"}), "--tile-size");
    expect_mistake(degs({"scene", "info", "synthetic:teapot"}), "teapot");
    expect_mistake(degs({"scene", "generate", "object", "--out", "scene.txt"}), ".ply");
    expect_mistake(degs({"scene", "generate", "object", "--gaussians", "-1", "--out", "x.ply"}),
                   "'-1'");
    expect_mistake(degs({"config", "--format", "xml"}), "xml");
    expect_mistake(degs({"config", "absent.yaml"}), "absent.yaml");
    expect_mistake(degs({"run\nrm", "\x01\xff"}), "not expected");
}

} // namespace
} // namespace degs::sim_test
