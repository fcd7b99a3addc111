// SPDX-License-Identifier: Apache-2.0
// degs motion, as a user calls it.
#include <fstream>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const char* const kMotionScene = "synthetic:object,gaussians=300";

Outcome motion(const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"motion",  config("degs-16"), config("gscore-16"),
                                       "--scene", kMotionScene,      "--width",
                                       "64",      "--out",           out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Outcome outcome = degs(arguments);
    outcome.err = without_progress(outcome.err);
    return outcome;
}

nlohmann::json document_in(const std::string& folder) {
    return nlohmann::json::parse(read_file(fs::path(folder) / "motion.json"));
}

std::string poses_file(const Folder& folder, const std::string& rows) {
    const std::string file = folder / "head.csv";
    std::ofstream(file) << "time_s,x,y,z,qw,qx,qy,qz\n" << rows;
    return file;
}

/// Every frame is what degs run says of its camera, if all have the lens of the first.
TEST(MotionRuns, GoesThroughTheCameras) {
    const Folder folder;
    const Outcome outcome =
        motion(folder / "m", {"--camera", "1", "--rates", "90,120", "--jobs", "2"});
    expect_success(outcome);
    const nlohmann::json written = document_in(folder / "m");
    EXPECT_EQ(written["frames"], 2);
    ASSERT_EQ(written["designs"].size(), 2U);
    ASSERT_EQ(written["designs"][1]["displays"].size(), 2U);
    for (const char* file : {"motion.csv", "index.html", "latency.svg", "refreshes.svg"}) {
        EXPECT_TRUE(fs::exists(fs::path(folder / "m") / file)) << file;
    }
    double worst = 0;
    for (const char* camera : {"1", "2"}) {
        expect_success(degs({"run", config("degs-16"), "--scene", kMotionScene, "--camera", camera,
                             "--width", "64", "--no-reference", "--out", folder / "r"}));
        const nlohmann::json report =
            nlohmann::json::parse(read_file(fs::path(folder / "r") / "report.json"));
        worst = std::max(worst, report["timing"]["latency_ms"].get<double>());
    }
    EXPECT_DOUBLE_EQ(written["designs"][0]["latency_ms"]["worst"].get<double>(), worst);
}

/// A frame of two eyes is what degs run says of them.
TEST(MotionRuns, HasTwoEyes) {
    const Folder folder;
    const std::vector<std::string> eyes{"--eyes", "0.3", "--units-per-metre", "2"};
    std::vector<std::string> more{"--camera", "2", "--crop", "8,4,40x30"};
    more.insert(more.end(), eyes.begin(), eyes.end());
    expect_success(motion(folder / "m", more));
    const nlohmann::json written = document_in(folder / "m");
    EXPECT_EQ(written["eyes_m"], 0.3);
    std::vector<std::string> run{"run", config("degs-16"), "--scene",   kMotionScene, "--width",
                                 "64",  "--out",           folder / "r"};
    run.insert(run.end(), more.begin(), more.end());
    expect_success(degs(run));
    EXPECT_EQ(written["designs"][0]["latency_ms"]["worst"],
              report_in(folder / "r")["timing"]["latency_ms"]);
}

/// A frame is what degs run says of it behind the frame before, in latency and in bytes; the first
/// keeps nothing.
TEST(MotionRuns, KeepListsOfTheFrameBefore) {
    const Folder folder;
    const std::vector<std::string> keep{"--set", "binning.keep_lists=true", "--set",
                                        "frames_in_flight=1"};
    const auto report_of = [&](const char* frames) {
        std::vector<std::string> run{"run", config("degs-16"), "--scene", kMotionScene, "--width",
                                     "64",  "--no-reference",  "--out",   folder / "r"};
        run.insert(run.end(), keep.begin(), keep.end());
        run.insert(run.end(), {"--frames", frames, "--path-step", "0"});
        expect_success(degs(run));
        return report_in(folder / "r");
    };
    const std::string head =
        poses_file(folder, "0,0,0,0,1,0,0,0\n0.1,0,0,0,1,0,0,0\n0.2,0,0,0,1,0,0,0\n");
    expect_success(motion(folder / "m", {"--poses", head, "--rates", "10", "--set",
                                         "binning.keep_lists=true", "--jobs", "2"}));
    const nlohmann::json kept = document_in(folder / "m")["designs"][0];
    const nlohmann::json one = report_of("1"), both = report_of("2");
    const double first = one["timing"]["cycles"], second = both["timing"]["cycles"];
    EXPECT_NEAR(kept["latency_ms"]["worst"].get<double>(), first * 1e-6, 1e-12); // at 1 GHz
    EXPECT_NEAR(kept["latency_ms"]["p50"].get<double>(), (second - first) * 1e-6, 1e-12);
    EXPECT_LT(second - first, first);
    const auto bytes = [](const nlohmann::json& report) {
        const auto& dram = report["dram"];
        return dram["bytes_read"].get<double>() + dram["bytes_written"].get<double>();
    };
    EXPECT_DOUBLE_EQ(kept["bytes_per_frame"].get<double>(), (2 * bytes(both) - bytes(one)) / 3);
}

/// The first frame is the camera's own; a head that stands still sees the same frame again.
TEST(MotionRuns, FollowsRecordedPoses) {
    const Folder folder;
    const std::string head =
        poses_file(folder, "10,5,1.6,5,1,0,0,0\n10.05,5,1.6,5,1,0,0,0\n10.1,5,1.7,5,0.8,0,0.6,0\n");
    const Outcome outcome =
        motion(folder / "m", {"--poses", head, "--camera", "1", "--rates", "20",
                              "--units-per-metre", "0.5", "--fidelity", "analytic"});
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("estimated"), std::string::npos) << outcome.out;
    const std::string table = read_file(fs::path(folder / "m") / "motion.csv");
    std::istringstream lines(table);
    std::vector<std::string> rows;
    for (std::string line; std::getline(lines, line);) {
        rows.push_back(line.substr(line.find(',', line.find(',') + 1) + 1));
    }
    ASSERT_EQ(rows.size(), 4U) << table;
    EXPECT_EQ(rows[1], rows[2]);
    EXPECT_NE(rows[2], rows[3]);
}

TEST(MotionRuns, RefusesInOneSentence) {
    const Folder folder;
    const std::string head = poses_file(folder, "0,0,0,0,1,0,0,0\n1000,0,0,0,1,0,0,0\n");
    for (const auto& [more, words] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--poses", folder / "none.csv"}, "none.csv"},
             {{"--poses", head}, "--frames takes the first ones"},
             {{"--poses", head, "--between", "3"}, "--between is for a path through cameras"},
             {{"--in-scene"}, "--in-scene is for recorded poses, so it needs --poses."},
             {{"--units-per-metre", "2"}, "so it needs --poses or --eyes."},
             {{"--eyes", "0.1", "--fidelity", "analytic"}, "frames with one view"},
             {{"--rates", "90,90"}, "--rates has 90 Hz twice"},
             {{"--rates", "0"}, "--rates"},
             {{"--rates", "fast"}, "--rates"},
             {{"--camera", "9"}, "9"},
         }) {
        expect_mistake(motion(folder / "m", more), words);
    }
}

} // namespace
} // namespace degs::sim_test
