// SPDX-License-Identifier: Apache-2.0
// What commands that simulate have in common: --memory, --camera-file, and units in --set.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const char* const kCommonScene = "synthetic:object,gaussians=300";

std::string small_study(const Folder& folder, const std::string& axes) {
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "study: s\ndesigns:\n  - include: " << config("degs-16")
                        << "\n    name: a\n  - include: " << config("gscore-16")
                        << "\n    name: b\n"
                        << axes << "scenes: " << kCommonScene << "\nwidth: 64\n";
    return file;
}

nlohmann::json json_in(const std::string& file) {
    return nlohmann::json::parse(read_file(file));
}

Outcome quiet(const std::vector<std::string>& arguments) {
    Outcome outcome = degs(arguments);
    outcome.err = without_progress(outcome.err);
    return outcome;
}

/// The cycles of a design of its own with the memory.
std::uint64_t cycles_of(const Folder& folder, const std::string& design,
                        const std::string& memory) {
    expect_success(degs({"run", config(design), "--scene", kCommonScene, "--width", "64",
                         "--memory", memory, "--out", folder / "r"}));
    const nlohmann::json report = report_in(folder / "r");
    EXPECT_EQ(report["config"]["memory"]["model"], "lpddr5");
    return report["timing"]["cycles"].get<std::uint64_t>();
}

TEST(MemoryOption, IsTheSameInEveryCommandThatSimulates) {
    const Folder folder;
    const std::string memory = config("memory/lpddr5-3200x128");
    const std::uint64_t degs_cycles = cycles_of(folder, "degs-16", memory);
    const std::uint64_t gscore_cycles = cycles_of(folder, "gscore-16", memory);
    const std::string study = small_study(folder, "axes:\n  clock_ghz: [x1]\n");
    EXPECT_EQ(quiet({"compare", config("degs-16"), config("gscore-16"), "--scene", kCommonScene,
                     "--width", "64", "--memory", memory, "--out", folder / "c"})
                  .code,
              0);
    EXPECT_EQ(quiet({"sweep", study, "--memory", memory, "--out", folder / "s"}).code, 0);
    EXPECT_EQ(quiet({"explore", study, "--memory", memory, "--out", folder / "e"}).code, 0);
    for (const char* const file : {"c/compare.json", "s/results.json", "e/results.json"}) {
        const nlohmann::json runs = json_in(folder / file)["runs"];
        ASSERT_EQ(runs.size(), 2U) << file;
        EXPECT_EQ(runs[0]["cycles"], degs_cycles) << file;
        EXPECT_EQ(runs[1]["cycles"], gscore_cycles) << file;
    }
    const Outcome speed = quiet({"accuracy", "--speed", config("degs-16"), "--scene", kCommonScene,
                                 "--resolution", "720p", "--fidelities", "exact", "--numbers",
                                 "fp32", "--memory", memory, "--out", folder / "a"});
    EXPECT_EQ(speed.code, 0) << speed.err;
    EXPECT_EQ(quiet({"soc", config("degs-16"), "--scene", kCommonScene, "--width", "64", "--load",
                     "0", "--memory", memory, "--out", folder / "p"})
                  .code,
              0);
}

TEST(MemoryOption, IsPartOfAPoint) {
    const Folder folder;
    const std::string study = small_study(folder, "");
    const auto runs = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"sweep", study, "--out", folder / "o"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = degs(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return json_in(folder / "o/results.json")["runs"][0]["cycles"].get<std::uint64_t>();
    };
    const std::uint64_t own = runs({});
    const std::uint64_t other = runs({"--memory", config("memory/lpddr5-3200x128")});
    EXPECT_NE(own, other);
    EXPECT_EQ(runs({}), own);
}

TEST(MemoryOption, IsRefusedWhereNoMemoryIsSimulated) {
    const std::string memory = config("memory/lpddr5-3200x128");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"render", "--scene", "synthetic:single"},
          {"scene", "info", "synthetic:single"}}) {
        std::vector<std::string> all = words;
        all.insert(all.end(), {"--memory", memory});
        expect_mistake(degs(all), "'--memory' is not expected here; it is an option of run, "
                                  "compare, sweep, explore, bandwidth, buffers, motion, "
                                  "soc, accuracy.");
    }
    expect_mistake(degs({"accuracy", "--scene", "synthetic:single", "--memory", memory}),
                   "--memory is for runs of configurations, so it needs --speed.");
    const Folder folder;
    expect_mistake(
        degs({"sweep", small_study(folder, "axes:\n  memory.model: [bandwidth, lpddr5]\n"),
              "--memory", memory, "--out", folder / "o"}),
        "'memory.model' is varied by an axis");
}

/// Two cameras; the first one at this distance.
std::string write_cameras(const Folder& folder, const std::string& name, double distance) {
    const std::string file = folder / name;
    std::ofstream cameras(file);
    cameras << "[";
    for (const double z : {-distance, -2 * distance}) {
        cameras << (z == -distance ? "" : ",")
                << R"({"width": 64, "height": 48, "fx": 60, "fy": 60, "position": [0, 0, )" << z
                << R"(], "rotation": [[1,0,0],[0,1,0],[0,0,1]]})";
    }
    cameras << "]";
    return file;
}

TEST(CameraFileOption, IsPartOfAPoint) {
    const Folder folder;
    const std::string study = small_study(folder, "axes:\n  clock_ghz: [1, 2]\n");
    for (const char* const command : {"sweep", "explore"}) {
        const std::string out = folder / command;
        const auto runs = [&](const std::string& cameras) {
            const Outcome outcome =
                degs({command, study, "--cameras", "0,1", "--camera-file", cameras, "--out", out});
            EXPECT_EQ(outcome.code, 0) << outcome.err;
            std::size_t count = 0;
            for (std::size_t at = 0; (at = outcome.err.find(" done · ", at)) != std::string::npos;
                 ++at) {
                ++count;
            }
            return count;
        };
        const std::string near = write_cameras(folder, "near.json", 3);
        EXPECT_EQ(runs(near), 8U) << command;
        EXPECT_EQ(runs(near), 0U) << command;
        EXPECT_EQ(runs(write_cameras(folder, "far.json", 4)), 8U) << command;
        EXPECT_EQ(runs(near), 0U) << command;
        write_cameras(folder, "near.json", 5); // another content under the same name
        EXPECT_EQ(runs(near), 8U) << command;
    }
    expect_mistake(degs({"sweep", study, "--cameras", folder / "near.json"}),
                   "a file of cameras is named by --camera-file");
}

TEST(Units, OfOverridesAreThoseOfAxes) {
    const Folder folder;
    const auto report = [&](const std::string& set) {
        EXPECT_EQ(degs({"run", config("degs-16"), "--scene", kCommonScene, "--width", "64",
                        "--no-reference", "--set", set, "--out", folder / "o"})
                      .code,
                  0);
        return report_in(folder / "o");
    };
    EXPECT_EQ(report("gaussian_buffer.bytes=64KB")["config"]["gaussian_buffer"]["bytes"], 65536);
    EXPECT_EQ(report("memory.bandwidth_gb_per_s=0.1TB/s")["config"]["memory"]["bandwidth_gb_per_s"],
              100);
    EXPECT_EQ(report("clock_ghz=750MHz")["config"]["clock_ghz"], 0.75);
    expect_mistake(degs({"run", config("degs-16"), "--scene", kCommonScene, "--set",
                         "gaussian_buffer.bytes=64ns", "--out", folder / "p"}),
                   "the unit 'ns' does not fit key 'gaussian_buffer.bytes'");
}

TEST(SweepList, ShowsTheSizeOfTheImages) {
    const Folder folder;
    const std::string study = small_study(folder, "");
    const auto list = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"sweep", study, "--list"};
        words.insert(words.end(), more.begin(), more.end());
        return degs(words).out;
    };
    EXPECT_NE(list({}).find("1  a, synthetic:object,gaussians=300, camera 0, 64×48\n"),
              std::string::npos)
        << list({});
    const std::string sizes = list({"--resolution", "720p,4k", "--camera", "1"});
    EXPECT_NE(sizes.find("1  a, synthetic:object,gaussians=300, camera 1, 1280×720\n"),
              std::string::npos)
        << sizes;
    EXPECT_NE(sizes.find("camera 1, 3840×2160\n"), std::string::npos) << sizes;
    const std::string exact = list({"--resolution", "64x80,65x80"});
    EXPECT_NE(exact.find("camera 0, 64×80\n"), std::string::npos) << exact;
    EXPECT_NE(exact.find("camera 0, 65×80\n"), std::string::npos) << exact;
}

} // namespace
} // namespace degs::sim_test
