// SPDX-License-Identifier: Apache-2.0
// degs soc, as a user calls it.
#include <algorithm>
#include <array>
#include <fstream>
#include <map>

#include "sim/soc/soc_study.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

TEST(SmallRunSoc, LatencyRisesWithTheLoadAndPixelsStay) {
    const Folder folder;
    const Outcome outcome = degs(
        {"soc", config("degs-16"), "--scene", "synthetic:object,gaussians=3000", "--width", "160",
         "--load", "0", "60", "120", "--cores", "2", "--refresh", "1000", "--out", folder / "out"});
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("the same under every load"), std::string::npos) << outcome.out;
    const auto written = nlohmann::json::parse(read_file(folder / "out/soc.json"));
    ASSERT_EQ(written["points"].size(), 3U);
    const auto& alone = written["points"][0];
    const auto& loaded = written["points"][2];
    EXPECT_EQ(alone["cpu_gb_per_s"], 0.0);
    EXPECT_GT(loaded["cpu_gb_per_s"], 10.0);
    EXPECT_LE(loaded["cpu_gb_per_s"], 121.0); // offered, and one line per core more
    EXPECT_GT(loaded["latency_ns"], alone["latency_ns"]);
    EXPECT_EQ(loaded["bytes_written"], alone["bytes_written"]);
    EXPECT_EQ(loaded["fragments"], alone["fragments"]);
    // A thousand pictures of 120 rows a second; nothing is shown before the first frame is there.
    const double row_gb_per_s = 160 * 4 / loaded["latency_ns"].get<double>();
    EXPECT_EQ(alone["display_gb_per_s"], 0.0);
    EXPECT_NEAR(loaded["display_gb_per_s"].get<double>(), 1e-9 * 1000 * 120 * 160 * 4,
                row_gb_per_s);
    EXPECT_NEAR(loaded["display_rows"].get<double>(),
                1e-9 * 1000 * 120 * loaded["latency_ns"].get<double>(), 1);
    std::uint64_t rows = 0, late = 0;
    for (const auto& point : written["points"]) {
        rows += point["display_rows"].get<std::uint64_t>();
        late += point["late_rows"].get<std::uint64_t>();
        EXPECT_LE(point["late_rows"], point["display_rows"]);
    }
    // A row may end between two frames.
    EXPECT_LE(rows, written["display"]["rows"]);
    EXPECT_GE(rows + written["points"].size(), written["display"]["rows"]);
    EXPECT_LE(late, written["display"]["underruns"]);
    EXPECT_GE(late + written["points"].size(), written["display"]["underruns"]);
    EXPECT_GT(written["psnr_db"], 45.0); // 8 bits alone: 20 log10(255 sqrt 12) = 58.9 dB
    EXPECT_NE(read_file(folder / "out/soc.svg").find("<svg"), std::string::npos);
}

const std::vector<std::string> kFewPixels{
    "--scene", "synthetic:object,gaussians=20", "--width", "32", "--load", "0", "--refresh", "0"};

std::vector<std::string> soc(const std::string& design, const std::vector<std::string>& more) {
    std::vector<std::string> words{"soc", design};
    words.insert(words.end(), kFewPixels.begin(), kFewPixels.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// A memory of its own, one frame at a time, a scene of floats: what a platform has no use for is
// refused.
TEST(SmallRunSoc, KeysThatAPlatformCannotFollowAreRefused) {
    const std::vector<std::array<std::string, 3>> keys{
        {"degs-16", "memory.bandwidth_gb_per_s=0.1", "a memory of its own, --memory"},
        {"degs-16", "memory.latency_ns=5000", "a memory of its own, --memory"},
        {"degs-16", "memory.lpddr5.timing.rcd=20", "a memory of its own, --memory"},
        {"degs-16", "frames_in_flight=1", "starts a frame when the one before has ended"},
        {"degs-16", "traffic.geometry_bytes=64", "as floats"},
        {"degs-16", "traffic.pixel_bytes=8", "the register FORMAT"},
        {"degs-16", "cost.logic.fo4_per_ns=50", "nothing is billed"}};
    for (const auto& [design, assignment, reason] : keys) {
        const Folder folder;
        SCOPED_TRACE(assignment);
        const std::string key = assignment.substr(0, assignment.find('='));
        const Outcome outcome = degs(soc(config(design), {"--set", assignment}));
        expect_mistake(outcome, "degs: --set " + assignment + ": key '" + key +
                                    "' has no effect on a platform, because ");
        expect_mistake(outcome, reason);
    }
}

TEST(SmallRunSoc, KeysOfAFileThatAPlatformCannotFollowAreWarnedOf) {
    const Folder folder;
    std::ofstream(folder / "far.yaml") << "include: " << config("degs-16")
                                       << "\nmemory: {latency_ns: 5000, layout: morton}\n"
                                          "frames_in_flight: 3\n";
    const Outcome far = degs(soc(folder / "far.yaml", {"--out", folder / "far"}));
    EXPECT_EQ(far.code, 0) << far.err;
    EXPECT_NE(far.err.find("far.yaml:2: key 'memory.latency_ns' has no effect on a platform"),
              std::string::npos)
        << far.err;
    EXPECT_NE(far.err.find("far.yaml:3: key 'frames_in_flight' has no effect on a platform"),
              std::string::npos)
        << far.err;
    EXPECT_EQ(far.err.find("layout"), std::string::npos) << far.err; // which it follows
    const Outcome shipped = degs(soc(config("degs-16"), {"--out", folder / "shipped"}));
    expect_success(shipped);
    EXPECT_EQ(shipped.err.find("no effect"), std::string::npos) << shipped.err;
}

TEST(SmallRunSoc, LoadsGoUpToThreeQuartersOfThePeak) {
    const Folder folder;
    expect_success(degs({"soc", config("degs-16"), "--scene", "synthetic:object,gaussians=20",
                         "--width", "32", "--cores", "1", "--out", folder / "out"}));
    const auto points = nlohmann::json::parse(read_file(folder / "out/soc.json"))["points"];
    ASSERT_EQ(points.size(), 7U);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_DOUBLE_EQ(points[i]["offered_gb_per_s"], 204.8 * static_cast<double>(i) / 8);
    }
}

// A row of 24 is due every 10 ns, in which no memory answers: all rows of a frame are late, and
// none of a frame before it is among them.
TEST(SmallRunSoc, LateRowsAreCountedFrameByFrame) {
    sim::SocRequest request;
    request.accelerators[0].config = sim::load_run_config(config("degs-16"), {}, "");
    request.loads = {0, 0, 0};
    request.cores = 1;
    request.refresh_hz = 4e6;
    sim::ViewRequest wanted;
    wanted.scene = "synthetic:object,gaussians=20";
    wanted.width = 32;
    const sim::SocResult result = sim::run_soc(request, sim::load_view(wanted));
    ASSERT_EQ(result.points.size(), 3U);
    EXPECT_EQ(result.points[0].late_rows, 0U); // nothing is shown before the first frame is there
    for (const std::size_t point : {1, 2}) {
        const sim::SocPoint& frame = result.points[point];
        EXPECT_GT(frame.display_rows, 10U);
        EXPECT_NEAR(static_cast<double>(frame.late_rows), static_cast<double>(frame.display_rows),
                    1); // one may be on its way
    }
}

// The traffic of each frame is in the time of that frame.
TEST(SmallRunSoc, HasATimelineOfTheAccelerator) {
    const Folder folder;
    expect_success(degs({"soc", config("degs-16"), "--scene", "synthetic:object,gaussians=500",
                         "--width", "160", "--load", "0", "60", "--cores", "2", "--out",
                         folder / "out", "--trace", folder / "trace.json"}));
    const auto trace = nlohmann::json::parse(read_file(folder / "trace.json"));
    const double step_us = trace["otherData"]["step_cycles"].get<double>() /
                           trace["otherData"]["clock_ghz"].get<double>() / 1e3;
    std::vector<std::pair<double, double>> frames; // us
    double useful = 0, outside = 0, before = 0, value = 0;
    for (const auto& event : trace["traceEvents"]) {
        if (event["ph"] == "X" && event["pid"] == 1) {
            frames.emplace_back(event["ts"],
                                event["ts"].get<double>() + event["dur"].get<double>());
        } else if (event["ph"] == "C" && event["name"] == "useful") {
            const double at = event["ts"];
            useful += value * (at - before) * 1e3;
            const bool inside =
                value == 0 ||
                (before > frames[0].first - step_us && at < frames[0].second + step_us) ||
                (before > frames[1].first - step_us && at < frames[1].second + step_us);
            outside += inside ? 0 : value;
            before = at;
            value = event["args"]["value"];
        }
    }
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_LT(frames[0].second, frames[1].first);
    EXPECT_EQ(outside, 0);
    // Each frame does what a run does.
    expect_success(degs({"run", config("degs-16"), "--scene", "synthetic:object,gaussians=500",
                         "--width", "160", "--no-reference", "--out", folder / "run"}));
    const auto report = report_in(folder / "run");
    EXPECT_NEAR(useful, 2 * report["slots"]["useful"].get<double>(), 1e-3);
}

/// A scene whose means are floats, as a platform has them.
std::string scene_of_floats(const Folder& folder) {
    const std::string scene = folder / "scene.ply";
    expect_success(degs({"scene", "generate", "object", "--gaussians", "700", "--out", scene}));
    return scene;
}

// Both eyes, each of three levels: every pixel is that of the run with these views.
TEST(SmallRunSoc, FoveatedEyesAreThoseOfARun) {
    const Folder folder;
    const std::vector<std::string> frame{
        "--scene", scene_of_floats(folder), "--width", "160",         "--eyes",
        "0.1",     "--units-per-metre",     "3",       "--foveation", "0.4,0.6:6:14"};
    for (const char* design : {"degs-16", "gcc-16"}) {
        SCOPED_TRACE(design);
        std::vector<std::string> on_platform{"soc",  config(design), "--load",
                                             "0",    "40",           "--refresh",
                                             "1000", "--out",        folder / "soc"};
        std::vector<std::string> alone{"run", config(design), "--no-cache", "--out",
                                       folder / "run"};
        on_platform.insert(on_platform.end(), frame.begin(), frame.end());
        alone.insert(alone.end(), frame.begin(), frame.end());
        const Outcome outcome = degs(on_platform);
        expect_success(outcome);
        EXPECT_NE(outcome.out.find("2 × 160×"), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find(" in 6 views"), std::string::npos) << outcome.out;
        expect_success(degs(alone));
        const auto soc = nlohmann::json::parse(read_file(folder / "soc/soc.json"));
        const auto run = report_in(folder / "run");
        ASSERT_EQ(soc["views"].size(), 6U);
        double cycles = 0, rows = 0, fragments = 0;
        for (std::size_t v = 0; v < 6; ++v) {
            const auto& view = soc["views"][v];
            const auto& same = run["views"]["first_frame"][v];
            const auto& level = run["foveation"]["images"][v / 3]["levels"][v % 3];
            EXPECT_EQ(view["crc32"], same["crc32"]) << v;
            EXPECT_EQ(view["image"], v / 3);
            EXPECT_EQ(view["scale"], level["scale"]);
            EXPECT_EQ(view["rectangle"], level["rectangle"]);
            EXPECT_GE(view["finished_cycles"], cycles);
            cycles = view["finished_cycles"];
            rows += view["height"].get<double>();
            fragments += view["fragments"].get<double>();
        }
        EXPECT_EQ(soc["points"][0]["cycles"], cycles);
        EXPECT_EQ(soc["points"][0]["fragments"], fragments);
        EXPECT_GT(soc["psnr_db"], 45.0);
        // The display shows all levels of a frame 1000 times a second.
        EXPECT_NEAR(soc["points"][1]["display_rows"].get<double>(),
                    1e-9 * 1000 * rows * soc["points"][1]["latency_ns"].get<double>(), 1);
    }
}

TEST(SmallRunSoc, LensesAndGroupsOfCamerasAreThoseOfARun) {
    const Folder folder;
    std::ofstream(folder / "cameras.json")
        << R"([{"width":80,"height":60,"position":[0,0,-4],"fx":70,"fy":70,)"
        << R"("rotation":[[1,0,0],[0,1,0],[0,0,1]],"camera_model":"OPENCV",)"
        << R"("distortion":[-0.1,0.02,0.001,0]},)"
        << R"({"width":80,"height":60,"position":[0.5,0,-4],"fx":80,"fy":80,"cx":33,"cy":30,)"
        << R"("rotation":[[1,0,0],[0,1,0],[0,0,1]]}])";
    const std::string scene = scene_of_floats(folder);
    const auto words = [&](const char* command, const std::vector<std::string>& more) {
        std::vector<std::string> all{command, config("degs-16"), "--scene",
                                     scene,   "--camera-file",   folder / "cameras.json",
                                     "--out", folder / command};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    const std::vector<std::string> bent{"--views", "0,1", "--set",
                                        "pipeline.rules.projection=unscented"};
    std::vector<std::string> soc = words("soc", bent);
    soc.insert(soc.end(), {"--load", "0", "--refresh", "0"});
    expect_success(degs(soc));
    expect_success(degs(words("run", bent)));
    const auto views = nlohmann::json::parse(read_file(folder / "soc/soc.json"))["views"];
    const auto report = report_in(folder / "run");
    ASSERT_EQ(views.size(), 2U);
    for (std::size_t v = 0; v < 2; ++v) {
        EXPECT_EQ(views[v]["crc32"], report["views"]["first_frame"][v]["crc32"]) << v;
    }
    expect_mistake(degs(words("soc", {"--load", "0"})), "which the linear projection cannot draw");
}

// Views that share nothing are frames, and the key says how many are in flight.
TEST(SmallRunSoc, FramesInFlightAreViewsThatShareNothing) {
    const Folder folder;
    const auto cycles = [&](const std::string& limit) {
        expect_success(degs(
            soc(config("degs-16"), {"--eyes", "0.1", "--set", "projection.shared_by_views=nothing",
                                    "frames_in_flight=" + limit, "--out", folder / limit})));
        const auto written = nlohmann::json::parse(read_file(folder / limit + "/soc.json"));
        return written["points"][0]["cycles"].get<double>();
    };
    EXPECT_GT(cycles("1"), cycles("2"));
}

/// Two accelerators on a memory that is too small for both; their levels, and others of the
/// options.
nlohmann::json of_two(const Folder& folder, const std::vector<std::string>& qos,
                      const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"soc",
                                   "--accelerator",
                                   config("gscore-64"),
                                   "--scene",
                                   "synthetic:object,gaussians=1500",
                                   "--width",
                                   "160",
                                   "--refresh",
                                   "0",
                                   "--memory",
                                   std::string(DEGS_CONFIGS) + "/memory/lpddr5-3200x128.yaml",
                                   "--out",
                                   folder / "two",
                                   "--accelerator",
                                   config("gscore-64"),
                                   "--rate",
                                   "0",
                                   "1e9",
                                   "--frames",
                                   "3",
                                   "--deadline",
                                   "0.01",
                                   "--qos"};
    words.insert(words.end(), qos.begin(), qos.end());
    words.insert(words.end(), more.begin(), more.end());
    expect_success(degs(words));
    return nlohmann::json::parse(read_file(folder / "two/soc.json"));
}

// The second one renders without a pause while the first is measured.
TEST(SmallRunSoc, SharesOfAcceleratorsFollowTheirLevels) {
    const Folder folder;
    std::map<std::string, double> slower; // by the levels
    for (const auto& qos : {std::vector<std::string>{"15", "0"}, {"4", "4"}, {"0", "15"}}) {
        SCOPED_TRACE(qos[0] + " and " + qos[1]);
        const auto written = of_two(folder, qos);
        ASSERT_EQ(written["points"].size(), 2U);
        const auto& alone = written["points"][0];
        const auto& both = written["points"][1];
        EXPECT_EQ(alone["others"][0]["frames"], 0);
        EXPECT_EQ(alone["others"][0]["gb_per_s"], 0.0);
        EXPECT_GE(both["others"][0]["frames"], 1);
        EXPECT_EQ(both["others"][0]["frames"],
                  both["others"][0]["late_frames"]); // of a period of 1 ns
        EXPECT_EQ(both["fragments"], alone["fragments"]);
        // Mean, longest and late frames once more from the frames themselves.
        double sum = 0, longest = 0;
        int late = 0;
        ASSERT_EQ(both["frames"].size(), 3U);
        for (const auto& frame : both["frames"]) {
            const double ns = frame["latency_ns"];
            sum += ns;
            longest = std::max(longest, ns);
            late += ns > 10000 ? 1 : 0;
        }
        EXPECT_NEAR(both["latency_ns"].get<double>(), sum / 3, 1e-6 * sum);
        EXPECT_EQ(both["longest_latency_ns"], longest);
        EXPECT_EQ(both["late_frames"], late);
        // What both got is what the memory can give.
        EXPECT_LE(both["accelerator_gb_per_s"].get<double>() +
                      both["others"][0]["gb_per_s"].get<double>(),
                  1.01 * 51.2);
        slower[qos[0]] = both["latency_ns"].get<double>() / alone["latency_ns"].get<double>();
    }
    EXPECT_LT(slower["15"], 0.95 * slower["4"]);
    EXPECT_GT(slower["0"], 1.05 * slower["4"]);
}

// The images of a frame do not depend on who else draws, and an accelerator that draws seldom is in
// time.
TEST(SmallRunSoc, AcceleratorsOfSeveralFamiliesDrawSideBySide) {
    const Folder folder;
    const std::string scene = scene_of_floats(folder);
    expect_success(degs({"soc",
                         config("degs-16"),
                         "--accelerator",
                         config("gcc-16"),
                         config("orange-o1"),
                         "--scene",
                         scene,
                         "--width",
                         "96",
                         "--qos",
                         "0",
                         "7",
                         "--rate",
                         "2000",
                         "--frames",
                         "2",
                         "--deadline",
                         "1e5",
                         "--refresh",
                         "1000",
                         "--display-qos",
                         "15",
                         "--cores-qos",
                         "3",
                         "--load",
                         "10",
                         "--cores",
                         "1",
                         "--out",
                         folder / "soc"}));
    expect_success(degs({"soc", config("degs-16"), "--scene", scene, "--width", "96", "--load", "0",
                         "--out", folder / "alone"}));
    const auto alone = nlohmann::json::parse(read_file(folder / "alone/soc.json"));
    const auto written = nlohmann::json::parse(read_file(folder / "soc/soc.json"));
    EXPECT_EQ(written["psnr_db"], alone["psnr_db"]);
    const auto& point = written["points"][0];
    EXPECT_EQ(point["fragments"], alone["points"][0]["fragments"]);
    EXPECT_EQ(point["late_frames"], 0);
    ASSERT_EQ(written["others"].size(), 2U);
    EXPECT_EQ(written["others"][0]["name"], "gcc-16");
    EXPECT_EQ(written["others"][0]["qos"], 7);
    EXPECT_EQ(written["others"][1]["qos"], 0);
    EXPECT_EQ(written["display"]["qos"], 15);
    EXPECT_EQ(written["cpu"]["qos"], 3);
    for (const auto& other : point["others"]) {
        EXPECT_EQ(other["late_frames"], 0);
        EXPECT_GT(other["gb_per_s"], 0.0);
    }
}

TEST(HostileSoc, AcceleratorsAndLevelsAreOneSentence) {
    const std::vector<std::string> scene{"--scene", "synthetic:object,gaussians=20"};
    const auto with = [&scene](std::vector<std::string> words) {
        words.insert(words.end(), scene.begin(), scene.end());
        return degs(words);
    };
    expect_mistake(with({"soc"}), "There is no accelerator");
    expect_mistake(with({"soc", config("degs-16"), "--qos", "1", "2"}), "--qos has 2 levels");
    expect_mistake(with({"soc", config("degs-16"), "--rate", "60"}), "there are none");
    EXPECT_EQ(with({"soc", config("degs-16"), "--qos", "16"}).code, 2);
    EXPECT_EQ(with({"soc", config("degs-16"), "--deadline", "0"}).code, 2);
    EXPECT_EQ(with({"soc", config("degs-16"), "--frames", "0"}).code, 2);
}

TEST(HostileSoc, BadArgumentsAreOneSentence) {
    EXPECT_EQ(degs({"soc"}).code, 2);
    EXPECT_EQ(degs({"soc", config("degs-16"), "--scene", "synthetic:object", "--load", "-1"}).code,
              2);
    EXPECT_EQ(
        degs({"soc", config("degs-16"), "--scene", "synthetic:object", "--memory", "none.yaml"})
            .code,
        2);
}

} // namespace
} // namespace degs::sim_test
