// SPDX-License-Identifier: Apache-2.0
// degs sweep as a user calls it: results, going on after a kill, shards.
#include <algorithm>
#include <csignal>
#include <map>
#include <random>

#include "tests/sim/process/child.hpp"
#include "tests/sim/process/csv_rows.hpp"

namespace degs::sim_test {
namespace {

const char* const kResults[] = {"results.csv", "results.json", "index.html"};

/// Writes a study of degs-64 with these lines and returns its file.
std::string study(const Folder& folder, const std::string& lines) {
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "study: small\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\nscenes: synthetic:object,gaussians=300\n"
                        << "width: 64\n"
                        << lines;
    return file;
}

const char* const kTwelve = "axes:\n  gaussian_buffer.bytes: x1/2..x2 x2\n"
                            "  span.count: [4, 8]\ncameras: [0, 1]\n";
/// 5 x 3 x 2, of which all can be built.
const char* const kThirty = "axes:\n  gaussian_buffer.bytes: x1/2..x8 x2\n"
                            "  span.count: [2, 4, 8]\n"
                            "  memory.bandwidth_gb_per_s: [102.4GB/s, 204.8GB/s]\n";

Outcome sweep(const std::string& file, const std::string& out,
              const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"sweep", file, "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Outcome outcome = degs(arguments);
    outcome.err = without_progress(outcome.err);
    return outcome;
}

void expect_same_results(const std::string& a, const std::string& b) {
    for (const char* file : kResults) {
        const std::string text = read_file(fs::path(a) / file);
        EXPECT_GT(text.size(), 100U);
        EXPECT_TRUE(text == read_file(fs::path(b) / file)) << file << " of " << a << " and " << b;
    }
}

/// The finished points in a folder with the times of their files.
std::map<std::string, fs::file_time_type> finished_in(const std::string& out) {
    std::map<std::string, fs::file_time_type> points;
    std::error_code none;
    for (const auto& file : fs::directory_iterator(fs::path(out) / "points", none)) {
        if (file.path().extension() == ".point") {
            points[file.path().filename()] = fs::last_write_time(file);
        }
    }
    return points;
}

TEST(SweepRuns, AgreeWithSingleRuns) {
    const Folder folder;
    const std::string file = study(folder, std::string(kTwelve) + "frames: 3\n");
    expect_success(sweep(file, folder / "o", {"--jobs", "2"}));
    const nlohmann::json written = nlohmann::json::parse(read_file(folder / "o/results.json"));
    ASSERT_EQ(written["runs"].size(), 12U);
    EXPECT_EQ(written["variants"].size(), 6U);
    EXPECT_EQ(written["views"].size(), 2U);
    EXPECT_EQ(written["missing"], 0);
    const auto baseline = written["baseline"].get<std::size_t>();
    EXPECT_EQ(written["variants"][baseline]["name"], "degs-64");
    const nlohmann::json& run = written["runs"][7]; // the second camera
    EXPECT_EQ(run["view"], 1);
    const nlohmann::json keys = written["variants"][run["variant"].get<std::size_t>()]["keys"];
    std::vector<std::string> single{"run",      config("degs-64"),
                                    "--scene",  "synthetic:object,gaussians=300",
                                    "--camera", "1",
                                    "--width",  "64",
                                    "--out",    folder / "r"};
    for (const auto& [key, value] : keys.items()) {
        single.insert(single.end(), {"--set", key + "=" + value.get<std::string>()});
    }
    EXPECT_EQ(degs(single).code, 0); // it may warn of --set
    const nlohmann::json report = report_in(folder / "r");
    EXPECT_EQ(run["cycles"], report["timing"]["cycles"]);
    EXPECT_EQ(run["limited_by"], report["stages"]["limited_by"]);
    EXPECT_EQ(run["stages"]["span"], report["stages"]["span"]["busy"]);
    EXPECT_EQ(run["image"]["psnr_db"], report["image"]["psnr_db"]);
    EXPECT_FALSE(run["throughput_fps"].is_null());
    nlohmann::json own =
        nlohmann::json::parse(read_file(folder / ("o/" + run["report"].get<std::string>())));
    nlohmann::json other = report;
    // Warnings name the place of a value, and single runs say what changes gain.
    for (const char* section : {"host", "warnings", "gains"}) {
        own.erase(section);
        other.erase(section);
    }
    EXPECT_EQ(own, other);
    const std::string csv = read_file(folder / "o/results.csv");
    EXPECT_EQ(csv.rfind("point,design,gaussian_buffer.bytes,span.count,accelerator,", 0), 0U);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
    EXPECT_EQ(csv.find("host"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "o/host.csv"));
}

TEST(SweepRuns, DoNotDependOnJobsAndShards) {
    const Folder folder;
    const std::string file = study(folder, kTwelve);
    expect_success(sweep(file, folder / "one"));
    expect_success(sweep(file, folder / "two", {"--jobs", "2"}));
    for (const char* shard : {"3/5", "1/5", "5/5", "2/5", "4/5"}) {
        EXPECT_FALSE(fs::exists(folder / "parts/results.csv"));
        expect_success(sweep(file, folder / "parts", {"--shard", shard}));
    }
    expect_success(sweep(file, folder / "parts", {"--collect"}));
    expect_same_results(folder / "one", folder / "two");
    expect_same_results(folder / "one", folder / "parts");
}

TEST(SweepRuns, CollectSaysWhatIsMissing) {
    const Folder folder;
    const std::string file = study(folder, kTwelve);
    expect_success(sweep(file, folder / "o", {"--shard", "1/3"}));
    const Outcome outcome = sweep(file, folder / "o", {"--collect"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.out.find("4 of 12 points · 8 missing"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("8 points are missing"), std::string::npos) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(read_file(folder / "o/results.json"))["missing"], 8);
}

TEST(SweepRuns, RefuseFoldersOfOthers) {
    const Folder folder;
    const std::string file = study(folder, kTwelve);
    fs::create_directory(folder / "c");
    std::ofstream(folder / "c/compare.json") << "{}";
    expect_mistake(degs({"sweep", file, "--out", folder / "c"}), "holds 'compare.json'");
    for (const char* other :
         {"[", "{}", "{\"schema\": [1]}", "{\"schema\": {\"name\": \"mine\"}}"}) {
        fs::create_directory(folder / "o");
        std::ofstream(folder / "o/study.json") << other;
        expect_mistake(degs({"sweep", file, "--out", folder / "o"}), "that is not a study's");
    }
}

TEST(SweepRuns, GoOnAfterAFailure) {
    const Folder folder;
    const std::string file = study(folder, kTwelve);
    expect_success(sweep(file, folder / "whole"));
    expect_success(sweep(file, folder / "o", {"--shard", "1/2"}));
    // A point that was cut off, and a folder in place of another.
    const auto whole = finished_in(folder / "whole");
    const auto half = finished_in(folder / "o");
    std::ofstream(folder / ("o/points/" + half.begin()->first)) << "degs-point 1";
    const auto left = std::find_if(whole.begin(), whole.end(), [&half](const auto& point) {
        return half.count(point.first) == 0;
    });
    ASSERT_NE(left, whole.end());
    const std::string blocked = folder / ("o/points/" + left->first);
    fs::create_directory(blocked);
    const Outcome broken = sweep(file, folder / "o");
    expect_mistake(broken, left->first + ": this is not a regular file");
    fs::remove(blocked);
    expect_success(sweep(file, folder / "o"));
    expect_same_results(folder / "whole", folder / "o");
}

/// Starts the sweep quietly and kills it after a while; false if it had ended by itself.
bool killed_after(std::chrono::milliseconds time, const std::string& file, const std::string& out) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
        ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
        ::execl(DEGS_PROGRAM, DEGS_PROGRAM, "sweep", file.c_str(), "--out", out.c_str(), "--jobs",
                "2", nullptr);
        ::_exit(127);
    }
    ::usleep(static_cast<useconds_t>(time.count() * 1000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status);
}

// At random moments, three times: no finished point is lost or made again, and the bytes agree.
TEST(SweepRuns, SurviveBeingKilled) {
    const Folder folder;
    const std::string file = study(folder, kThirty);
    const auto start = std::chrono::steady_clock::now();
    expect_success(sweep(file, folder / "whole"));
    const auto whole = std::chrono::steady_clock::now() - start;
    ASSERT_EQ(finished_in(folder / "whole").size(), 30U);
    std::mt19937 random(std::random_device{}());
    std::map<std::string, fs::file_time_type> before;
    int killed = 0;
    for (int k = 0; k < 3; ++k) {
        const double share = std::uniform_real_distribution<>(0.05, 0.25)(random);
        const auto time = std::chrono::duration_cast<std::chrono::milliseconds>(whole * share);
        killed += killed_after(time, file, folder / "o") ? 1 : 0;
        const auto after = finished_in(folder / "o");
        for (const auto& [point, date] : before) {
            EXPECT_EQ(after.count(point), 1U) << point;
            EXPECT_EQ(after.at(point), date) << point << " was made again";
        }
        before = after;
    }
    EXPECT_GE(killed, 1);
    expect_success(sweep(file, folder / "o", {"--jobs", "2"}));
    for (const auto& [point, date] : before) {
        EXPECT_EQ(finished_in(folder / "o").at(point), date) << point << " was made again";
    }
    expect_same_results(folder / "whole", folder / "o");
    for (const auto& entry : fs::recursive_directory_iterator(folder / "o")) {
        EXPECT_EQ(entry.path().string().find(".partial-"), std::string::npos) << entry.path();
    }
}

// The buffers of Table I from a quarter to four times their size on two scenes: the table, the
// plots and the area come from the shipped study and one command.
TEST(LongSweepCommand, AnArchitectsAfternoon) {
    const Folder folder;
    const Outcome outcome =
        sweep(config("studies/buffers"), folder / "o",
              {"--scene", "synthetic:object,gaussians=3000", "--scene",
               "synthetic:outdoor,gaussians=3000", "--camera", "0", "--width", "160"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("buffers: 40 of 40 points · 1 cannot be built\ncannot be built: "),
              std::string::npos)
        << outcome.out;
    const auto rows = rows_by_heading(read_file(folder / "o/results.csv"));
    const std::map<std::string, double> table{{"gaussian_buffer.bytes", 73728},
                                              {"span_buffer.bytes", 2048},
                                              {"packing.bytes", 32768},
                                              {"feature_buffer.bytes", 8192},
                                              {"pixel_buffer.bytes", 16384}};
    for (const char* scene : {"object", "outdoor"}) {
        for (const auto& [key, bytes] : table) {
            for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
                const auto of_point = [&, &key = key, &bytes = bytes](const auto& row) {
                    const bool others = std::all_of(table.begin(), table.end(), [&](const auto& o) {
                        return o.first == key || std::stod(row.at(o.first)) == o.second;
                    });
                    return others && row.at("scene") == scene &&
                           std::stod(row.at(key)) == factor * bytes;
                };
                const auto row = std::find_if(rows.begin(), rows.end(), of_point);
                if (key == "pixel_buffer.bytes" && factor == 0.25) { // holds no tile
                    EXPECT_EQ(row, rows.end());
                    continue;
                }
                ASSERT_NE(row, rows.end()) << scene << " " << key << " x" << factor;
                EXPECT_GT(std::stod(row->at("area_mm2")), 1);
                EXPECT_GT(std::stod(row->at("latency_ms")), 0);
                EXPECT_GT(std::stod(row->at("ratio.latency_per_mm2")), 0.1);
                EXPECT_FALSE(row->at("limited_by").empty());
            }
        }
    }
    const std::string page = read_file(folder / "o/index.html");
    for (const char* part : {"\"gaussian_buffer.bytes\"", "\"area_mm2\"", "id=\"plot\"",
                             "\"report\":\"reports/000040.json\""}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    EXPECT_TRUE(fs::exists(folder / "o/reports/000040.json"));
}

TEST(SweepCommand, OptionsReplaceTheStudysViews) {
    const Folder folder;
    const Outcome outcome =
        degs({"sweep", config("studies/ablation"), "--scene", "synthetic:single", "--camera", "0",
              "--width", "64", "--no-reference", "--array-only", "--out", folder / "o"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("\n4 of 4 points done · neither, single · camera 0"),
              std::string::npos)
        << outcome.err;
    const nlohmann::json written = nlohmann::json::parse(read_file(folder / "o/results.json"));
    EXPECT_EQ(written["array_only"], true);
    EXPECT_TRUE(written["runs"][0]["image"]["psnr_db"].is_null());
    EXPECT_NE(degs({"sweep", config("studies/ablation"), "--scene", "synthetic:single", "--camera",
                    "0", "--width", "64", "--list"})
                  .out.find("4  neither, synthetic:single, camera 0"),
              std::string::npos);
}

// As if the design's file had it, whoever runs the points.
TEST(SweepRuns, TakeOverridesOfAllDesigns) {
    const Folder folder;
    const std::string axis = "axes:\n  span.count: [4, 8]\n";
    const std::string file = study(folder, axis);
    const std::vector<std::string> set{"--set", "memory.latency_ns=50", "--set",
                                       "degs-64:slicing.count=4"};
    expect_success(sweep(file, folder / "o", set));
    for (const char* point : {"000001", "000002"}) {
        const auto report = nlohmann::json::parse(
            read_file(folder / ("o/reports/" + std::string(point) + ".json")));
        EXPECT_EQ(report["config"]["memory"]["latency_ns"], 50);
        EXPECT_EQ(report["config"]["slicing"]["count"], 4);
    }
    const auto mistake = [&](const char* text, const char* words) {
        expect_mistake(degs({"sweep", file, "--out", folder / "m", "--set", text}), words);
    };
    mistake("span.count=4", "is varied by an axis at ");
    mistake("gbu-64:tile_size=16", "no configuration is called so");
    mistake("packing.byte=1024", "did you mean");
}

TEST(HostileSweep, Mistakes) {
    const Folder folder;
    const std::string file = study(folder, kTwelve);
    const auto mistake = [&](const std::vector<std::string>& more, const std::string& words) {
        std::vector<std::string> arguments{"sweep", file, "--out", folder / "o"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_mistake(degs(arguments), words);
    };
    for (const char* shard : {"", "0/2", "3/2", "1", "1/", "1/2/3", "-1/2", "a/b", "1/9999999"}) {
        mistake({"--shard", shard}, "--shard");
    }
    mistake({"--shard", "auto"}, "--shard auto needs a task of a job array");
    mistake({"--shard", "1/2", "--collect"}, "--collect");
    mistake({"--scene", folder / "absent.ply"}, "absent.ply");
    mistake({"--camera", "77"}, "Camera 77 does not exist");
    EXPECT_FALSE(fs::exists(folder / "o"));
    expect_mistake(degs({"sweep", folder / "absent.yaml"}), "absent.yaml");
    expect_mistake(degs({"sweep", config("degs-64")}), "names no scene");
    expect_mistake(degs({"compare", file, "--scene", "synthetic:single"}), "is for 'degs sweep'");
    std::ofstream(folder / "goals.yaml")
        << "points: [{ include: " << config("degs-64") << ", name: a }]\ngoals: latency_ms\n";
    expect_mistake(degs({"compare", folder / "goals.yaml", "--scene", "synthetic:single"}),
                   "'goals'");
}

} // namespace
} // namespace degs::sim_test
