// SPDX-License-Identifier: Apache-2.0
// degs compare and degs run --frames, as a user calls them.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <set>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const char* const kComparedScene = "synthetic:object,gaussians=300";

nlohmann::json comparison_in(const std::string& folder) {
    return nlohmann::json::parse(read_file(fs::path(folder) / "compare.json"));
}

Outcome compare(std::vector<std::string> configs, const std::string& out,
                const std::vector<std::string>& more, const std::string& scene = kComparedScene) {
    std::vector<std::string> arguments{"compare"};
    arguments.insert(arguments.end(), configs.begin(), configs.end());
    arguments.insert(arguments.end(), {"--scene", scene, "--out", out});
    arguments.insert(arguments.end(), more.begin(), more.end());
    Outcome outcome = degs(arguments);
    outcome.err = without_progress(outcome.err);
    return outcome;
}

std::size_t lines_of(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// The camera stands still before a scene that changes, and no angle is told.
TEST(CompareRuns, SaysThatTheSceneChanges) {
    const Folder folder;
    const Outcome outcome = compare({config("degs-16"), config("gscore-16")}, folder / "c",
                                    {"--width", "64", "--frames", "2", "--no-reference"},
                                    "synthetic:dynamic,gaussians=300");
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("the first 2 frames of a scene that changes"), std::string::npos)
        << outcome.out;
    EXPECT_EQ(outcome.out.find("°"), std::string::npos) << outcome.out;
    const nlohmann::json written = comparison_in(folder / "c");
    EXPECT_EQ(written["frames"], 2);
    EXPECT_TRUE(written["path_step_degrees"].is_null());
}

// Not a SmallRun: the address sanitizer warns on stderr when a forked child leaves from a stack of
// SystemC's, and these runs must be silent there.
TEST(CompareRuns, AgreesWithSingleRuns) {
    const Folder folder;
    const Outcome outcome =
        compare({config("degs-16"), config("degs-64")}, folder / "c",
                {"--cameras", "1,0", "--width", "96", "--frames", "3", "--jobs", "2"});
    expect_success(outcome);
    const nlohmann::json written = comparison_in(folder / "c");
    ASSERT_EQ(written["runs"].size(), 4U);
    ASSERT_EQ(written["views"].size(), 2U);
    EXPECT_EQ(written["views"][0]["camera"], 1);
    EXPECT_EQ(written["means"].size(), 2U);
    EXPECT_EQ(written["frames"], 3);
    EXPECT_EQ(written["runs"][0]["ratio"]["latency"], 1);
    EXPECT_EQ(written["runs"][0]["ratio"]["throughput"], 1);
    EXPECT_EQ(written["path_step_degrees"], 0.5);
    EXPECT_NE(outcome.out.find("over 3 frames of 0.5° each"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("geometric means over 2 views"), std::string::npos);
    EXPECT_EQ(lines_of(read_file(folder / "c/compare.csv")), 5U);
    EXPECT_TRUE(fs::exists(folder / "c/slots.svg"));
    EXPECT_TRUE(fs::exists(folder / "c/utilization.svg"));
    EXPECT_TRUE(fs::exists(folder / "c/reports/1-object-camera1-96x54/2-degs-64-path.json"));

    const nlohmann::json& row = written["runs"][3]; // degs-64, camera 0
    const std::vector<std::string> single{
        "run", config("degs-64"), "--scene", kComparedScene, "--camera",
        "0",   "--width",         "96",      "--out",        folder / "r"};
    expect_success(degs(single));
    const nlohmann::json report = report_in(folder / "r");
    EXPECT_EQ(row["cycles"], report["timing"]["cycles"]);
    EXPECT_EQ(row["slots"]["utilization"], report["slots"]["utilization"]);
    EXPECT_EQ(row["dram"]["bytes_read"], report["dram"]["bytes_read"]);
    EXPECT_EQ(row["image"]["psnr_db"], report["image"]["psnr_db"]);
    EXPECT_TRUE(report["timing"]["throughput_fps"].is_null());
    // Both reports are the same to the last byte, except for what the machine did.
    nlohmann::json own = nlohmann::json::parse(
        read_file(folder / "c/reports/2-object-camera0-96x72/2-degs-64.json"));
    nlohmann::json other = report;
    own.erase("host");
    other.erase("host");
    other.erase("gains"); // of single runs
    EXPECT_EQ(own, other);

    std::vector<std::string> path = single;
    path.insert(path.end(), {"--frames", "3"});
    expect_success(degs(path));
    const nlohmann::json timing = report_in(folder / "r")["timing"];
    EXPECT_EQ(timing["frames"], 3);
    EXPECT_EQ(row["throughput_fps"], timing["throughput_fps"]);
    const auto& ends = timing["frame_finished_cycles"];
    ASSERT_EQ(ends.size(), 3U);
    EXPECT_NEAR(timing["throughput_fps"].get<double>(),
                1e9 / (ends[1].get<double>() - ends[0].get<double>()), 1e-3);
}

/// degs-16 that computes in half precision.
std::string half_precision(const Folder& folder) {
    const std::string file = folder / "half.yaml";
    std::ofstream(file) << "include: " << config("degs-16") << "\npipeline: { numbers: fp16 }\n";
    return file;
}

// An image has the error of its own numbers, and an eye changes against itself, not the other eye.
TEST(CompareRuns, OfEyesAndNumbersAgreeWithSingleRuns) {
    const Folder folder;
    const std::vector<std::string> options{"--width", "64", "--eyes", "0.06", "--frames", "2"};
    const std::string half = half_precision(folder);
    expect_success(compare({config("degs-16"), half}, folder / "c", options));
    const nlohmann::json written = comparison_in(folder / "c");
    std::vector<std::string> single{"run", half, "--scene", kComparedScene, "--out", folder / "r"};
    single.insert(single.end(), options.begin(), options.end());
    expect_success(degs(single));
    const nlohmann::json report = report_in(folder / "r");
    EXPECT_EQ(written["views"][0]["changes"], report["changes"]);
    EXPECT_LE(report["changes"]["active_overlap"].get<double>(), 1);
    EXPECT_EQ(written["runs"][1]["image"]["psnr_db"], report["image"]["psnr_db"]);
    EXPECT_NE(written["runs"][1]["image"]["psnr_db"], written["runs"][0]["image"]["psnr_db"]);
}

std::size_t rows_of(const std::string& design, const std::string& tables) {
    std::istringstream lines(tables);
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line);) {
        rows += line.rfind(design + " ", 0) == 0 ? 1 : 0;
    }
    return rows;
}

// Four tables for each of two views, and two of means.
TEST(CompareCommand, TellsAViewWhenAllItsRunsHaveEnded) {
    const Folder folder;
    const Outcome outcome = compare({config("degs-16"), half_precision(folder)}, folder / "c",
                                    {"--width", "64", "--cameras", "0,1", "--jobs", "1"});
    expect_success(outcome);
    EXPECT_EQ(rows_of("degs-16", outcome.out), 10U) << outcome.out;
    EXPECT_EQ(rows_of("half", outcome.out), 10U) << outcome.out;
}

// The reference is that of double whatever a configuration projects in, and made once.
TEST(CompareRuns, ProjectionsShareTheReference) {
    const Folder folder;
    const auto design = [&folder](const std::string& numbers) {
        const std::string path = folder / (numbers + ".yaml");
        std::ofstream(path) << "include: " << config("degs-64") << "\nname: " << numbers
                            << "\npipeline:\n  numbers: " << numbers << "\n";
        return path;
    };
    const std::string fp32 = design("fp32"); // projects in double
    const std::string tuned = design("tuned");
    const std::vector<std::string> view{"--cameras", "0", "--width", "96"};
    expect_success(compare({fp32, tuned}, folder / "c", view));
    expect_success(compare({tuned, fp32}, folder / "d", view));
    const auto read = [&](const char* path) {
        nlohmann::json report = nlohmann::json::parse(read_file(folder / path));
        report.erase("host");
        return report;
    };
    const nlohmann::json native = read("c/reports/1-object-camera0-96x72/1-fp32.json");
    const nlohmann::json own = read("c/reports/1-object-camera0-96x72/2-tuned.json");
    EXPECT_EQ(native, read("d/reports/1-object-camera0-96x72/2-fp32.json"));
    EXPECT_EQ(own, read("d/reports/1-object-camera0-96x72/1-tuned.json"));
    EXPECT_EQ(native["workload"]["projection"], "fp64");
    EXPECT_EQ(own["workload"]["projection"], "fp32");
    EXPECT_EQ(native["workload"]["fragments"], own["workload"]["fragments"]);
    const std::vector<std::string> single{"run",      tuned,       "--scene", kComparedScene,
                                          "--camera", "0",         "--width", "96",
                                          "--out",    folder / "r"};
    expect_success(degs(single));
    nlohmann::json report = report_in(folder / "r");
    report.erase("host");
    report.erase("gains");
    EXPECT_EQ(own, report);
}

TEST(CompareRuns, DoesNotDependOnJobs) {
    const Folder folder;
    std::vector<nlohmann::json> results;
    for (const char* jobs : {"1", "3"}) {
        expect_success(
            compare({"a=" + config("degs-64"), "b=" + config("degs-64"), "c=" + config("degs-16")},
                    folder / jobs,
                    {"--width", "64", "--set", "b:memory.bandwidth_gb_per_s=20", "--jobs", jobs}));
        results.push_back(comparison_in(folder / jobs));
        for (nlohmann::json& run : results.back()["runs"]) {
            run.erase("host");
        }
    }
    EXPECT_EQ(results[0], results[1]);
    ASSERT_EQ(results[0]["runs"].size(), 3U);
    EXPECT_LT(results[0]["runs"][1]["ratio"]["latency"], 1); // less bandwidth
    EXPECT_EQ(results[0]["runs"][2]["config"], "c");
}

// The option scales what is shown by the areas, and changes no result.
TEST(CompareRuns, ScalesToEqualArea) {
    const Folder folder;
    const std::vector<std::string> configs{config("degs-16"), config("degs-64")};
    const std::vector<std::string> views{"--cameras", "0,1", "--width", "64", "--no-reference"};
    std::vector<std::string> equal = views;
    equal.emplace_back("--equal-area");
    const Outcome own = compare(configs, folder / "own", views);
    const Outcome scaled = compare(configs, folder / "equal", equal);
    expect_success(own);
    expect_success(scaled);
    EXPECT_EQ(own.out.find("at the area of"), std::string::npos);
    EXPECT_NE(scaled.out.find("at the area of degs-16, 1.67 mm²"), std::string::npos) << scaled.out;
    EXPECT_NE(scaled.out.find("geometric means  "), std::string::npos) << scaled.out;
    const nlohmann::json mean = comparison_in(folder / "own")["means"][1]["ratio"];
    EXPECT_EQ(mean, comparison_in(folder / "equal")["means"][1]["ratio"]);
    for (const auto& [folder_name, key] :
         {std::pair("own", "latency"), std::pair("own", "energy"),
          std::pair("equal", "latency_per_mm2"), std::pair("equal", "energy_per_mm2")}) {
        char number[20];
        std::snprintf(number, sizeof number, ">%.2f<", mean[key].get<double>());
        const std::string svg = read_file(fs::path(folder / folder_name) / "ratios.svg");
        EXPECT_NE(svg.find(number), std::string::npos) << key << " " << number;
        EXPECT_NE(svg.find("geometric mean"), std::string::npos);
    }
}

TEST(CompareRuns, LeavesOutWhatIsNotAskedFor) {
    const Folder folder;
    std::ofstream(folder / "utilization.svg") << "of an earlier comparison";
    const Outcome outcome = compare({config("degs-64")}, folder / ".",
                                    {"--width", "64", "--no-reference", "--array-only"});
    expect_success(outcome);
    const nlohmann::json written = comparison_in(folder / ".");
    const nlohmann::json& run = written["runs"][0];
    EXPECT_EQ(written["array_only"], true);
    EXPECT_TRUE(run["dram"]["bytes_read"].is_null());
    EXPECT_TRUE(run["image"]["psnr_db"].is_null());
    EXPECT_TRUE(run["throughput_fps"].is_null());
    EXPECT_TRUE(written["views"][0]["fragments"].is_null());
    EXPECT_TRUE(written["means"].empty());
    EXPECT_FALSE(fs::exists(folder / "utilization.svg"));
    EXPECT_EQ(outcome.out.find("PSNR"), std::string::npos);
}

TEST(CompareCommand, AllConfigurationsOnOneView) {
    const Folder folder;
    std::vector<std::string> configs;
    std::set<std::string> names;
    for (const auto& file : fs::directory_iterator(DEGS_CONFIGS)) {
        // Other files of the folder describe parts of an accelerator, or studies.
        if (file.path().extension() == ".yaml" && degs({"config", file.path()}).code == 0) {
            configs.push_back(file.path().string());
            names.insert(file.path().stem().string());
        }
    }
    expect_success(compare(configs, folder / "c", {"--width", "96", "--cameras", "2"}));
    const nlohmann::json written = comparison_in(folder / "c");
    for (const auto& run : written["runs"]) {
        names.erase(run["config"]);
        const auto& slots = run["slots"];
        double sum = 0;
        for (const char* part : {"useful", "boundary", "terminated", "conflict", "ports", "padding",
                                 "starved", "blocked", "drain"}) {
            sum += slots[part].get<double>();
        }
        EXPECT_NEAR(sum, 1, 1e-9) << run["config"];
        EXPECT_GT(run["image"]["psnr_db"], 30) << run["config"];
    }
    EXPECT_TRUE(names.empty()) << *names.begin();
}

TEST(CompareCommand, AFailureIsNamedAndTheRestReported) {
    const Folder folder;
    std::ofstream(folder / "broken.ply") << "ply\n";
    write_camera(folder / "cameras.json", {0, 0, -3});
    const Outcome outcome = compare({config("degs-64")}, folder / "c",
                                    {"--width", "64", "--scene", folder / "broken.ply"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(lines_of(outcome.err), 1U) << outcome.err;
    EXPECT_NE(outcome.err.find("broken.ply"), std::string::npos);
    EXPECT_NE(outcome.out.find("failed: "), std::string::npos) << outcome.out;
    const nlohmann::json written = comparison_in(folder / "c");
    EXPECT_EQ(written["runs"].size(), 1U);
}

// What can be seen before is refused before anything runs.
TEST(HostileCompare, ChecksAllScenesAndCamerasFirst) {
    const Folder folder;
    write_camera(folder / "one.json", {0, 0, -3});
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--cameras", "0,77"},
          {"--scene", folder / "absent.ply"},
          {"--scene", "synthetic:single", "--cameras", "1,5"},
          {"--camera-file", folder / "one.json", "--cameras", "0,1"},
          {"--camera-file", folder / "absent.json"},
          {"--scene", "synthetic:no-such-scene"}}) {
        std::vector<std::string> all{"compare",      config("degs-64"), "--scene",
                                     kComparedScene, "--width",         "64",
                                     "--out",        folder / "d"};
        all.insert(all.end(), more.begin(), more.end());
        expect_mistake(degs(all), "");
        EXPECT_FALSE(fs::exists(folder / "d"));
    }
}

/// The program in the background, its messages in a file.
pid_t start(std::vector<std::string> arguments, const std::string& messages) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
        ::dup2(::open(messages.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        arguments.insert(arguments.begin(), DEGS_PROGRAM);
        std::vector<char*> argv;
        for (std::string& argument : arguments) {
            argv.push_back(argument.data());
        }
        argv.push_back(nullptr);
        ::execv(DEGS_PROGRAM, argv.data());
        ::_exit(127);
    }
    return child;
}

int end_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

/// A process whose parent is `parent`, 0 if there is none.
pid_t child_of(pid_t parent) {
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string stat = read_file(entry.path() / "stat"); // pid (name) state parent ...
        const std::size_t name_end = stat.rfind(')');
        if (name_end != std::string::npos && std::atoi(&stat[name_end + 4]) == parent) {
            return std::atoi(stat.c_str());
        }
    }
    return 0;
}

TEST(CompareCommand, ARunThatBreaksCostsOnlyItself) {
    const Folder folder;
    const std::string out = folder / "c";
    const pid_t program =
        start({"compare", "a=" + config("degs-64"), "b=" + config("degs-64"), "--scene",
               kComparedScene, "--no-reference", "--resolution", "2k", "--out", out},
              folder / "err");
    pid_t victim = 0;
    for (int i = 0; i < 4000 && victim == 0; ++i) {
        ::usleep(5000);
        victim = child_of(program);
    }
    ASSERT_NE(victim, 0);
    ::kill(victim, SIGKILL);
    const int status = end_of(program);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    const std::string message = without_progress(read_file(folder / "err"));
    EXPECT_EQ(message.rfind("degs: a, object · camera 0 · 1920×1440: The process was ended", 0), 0U)
        << message;
    EXPECT_EQ(lines_of(message), 1U) << message;
    const nlohmann::json written = comparison_in(out);
    ASSERT_EQ(written["runs"].size(), 1U);
    EXPECT_EQ(written["runs"][0]["config"], "b");
    EXPECT_TRUE(written["runs"][0]["ratio"]["latency"].is_null()); // nothing to compare with
    EXPECT_EQ(written["failed"][0]["config"], "a");
    EXPECT_TRUE(written["configs"][0]["pes"].is_null());
}

TEST(CompareCommand, AnInterruptKeepsWhatIsFinished) {
    const Folder folder;
    const std::string out = folder / "c";
    const pid_t program =
        start({"compare", config("degs-64"), "--scene", kComparedScene, "--scene",
               "synthetic:object", "--no-reference", "--resolution", "4k", "--out", out},
              folder / "err");
    for (int i = 0; i < 2000 && !fs::exists(out + "/compare.json"); ++i) {
        ::usleep(20000);
    }
    ::usleep(100000);
    ::kill(program, SIGINT);
    // While a scene is read nothing has to be put in order, and the signal acts at once.
    const int status = end_of(program);
    EXPECT_TRUE(WIFSIGNALED(status) ? WTERMSIG(status) == SIGINT : WEXITSTATUS(status) == 130)
        << status;
    EXPECT_EQ(without_progress(read_file(folder / "err")),
              "degs: Interrupted after 1 of 2 runs; what they found is in '" + out + "/'.\n");
    EXPECT_EQ(comparison_in(out)["runs"].size(), 1U);
}

TEST(HostileCompare, Mistakes) {
    const Folder folder;
    const std::string file = config("degs-64");
    const auto bad = [&](const std::vector<std::string>& configs,
                         const std::vector<std::string>& more, const std::string& words) {
        expect_mistake(compare(configs, folder / "c", more), words);
        EXPECT_FALSE(fs::exists(folder / "c/compare.json"));
    };
    bad({"absent.yaml"}, {}, "absent.yaml");
    bad({file, file}, {}, "NAME=FILE");
    bad({file}, {"--scene", kComparedScene}, "twice");
    bad({file}, {"--cameras", "99"}, "Camera 99");
    bad({file}, {"--cameras", "0,0"}, "twice");
    bad({file}, {"--cameras", "first"}, "'first'");
    bad({file}, {"--resolution", "4k,hd"}, "'hd'");
    bad({file}, {"--resolution", "4k", "--width", "64"}, "--width");
    bad({file}, {"--width", "0"}, "--width is 0");
    bad({file}, {"--frames", "0"}, "--frames");
    bad({file}, {"--path-step", "2"}, "--frames");
    bad({file}, {"--frames", "2", "--path-step", "91"}, "--path-step");
    bad({file}, {"--jobs", "0"}, "--jobs");
    bad({file}, {"--set", "other:clock_ghz=1"}, "'other'");
    bad({file}, {"--set", "nonsense=1"}, "nonsense");
    // A tile whose pixels have no room in the Pixel Buffer.
    bad({file}, {"--set", "degs-64:pixel_buffer.bytes=64"}, "pixel_buffer");
    expect_mistake(degs({"compare", file}), "--scene");
    expect_mistake(degs({"compare", "--scene", kComparedScene}), "config");
    expect_mistake(compare({file}, folder / "c", {}, "synthetic:teapot"), "teapot");
    expect_mistake(compare({file}, folder / "c", {}, ""), "empty");
    std::ofstream(folder / "file") << "x";
    expect_mistake(compare({file}, folder / "file", {}), "file");
    expect_mistake(compare({file}, "/proc/x", {}), "/proc/x");
}

} // namespace
} // namespace degs::sim_test
