// SPDX-License-Identifier: Apache-2.0
// degs sweep --sort: the best designs of a study by any goals.
#include <cmath>
#include <map>

#include <gmock/gmock.h>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using testing::HasSubstr;

/// Six designs on two views, and one that breaks the study's limit of the area.
std::string ranked_study(const Folder& folder, const std::string& limits = "") {
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "study: small\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\naxes:\n  span.count: [2, 8]\n"
                        << "  memory.bandwidth_gb_per_s: [12.8, 51.2, 204.8]\n"
                        << "scenes: synthetic:object,gaussians=300\ncameras: [0, 2]\nwidth: 64\n"
                        << "reference: false\n"
                        << limits;
    return file;
}

Outcome sorted_sweep(const std::string& file, const std::string& out,
                     std::vector<std::string> options) {
    options.insert(options.begin(), {"sweep", file, "--out", out, "--sort"});
    Outcome outcome = degs(options);
    outcome.err = without_progress(outcome.err);
    return outcome;
}

/// The first word of the lines of the table, which begins with "best".
std::vector<std::string> ranked(const std::string& text) {
    std::istringstream lines(text);
    std::vector<std::string> names;
    std::string line;
    bool inside = false;
    while (std::getline(lines, line)) {
        const std::string word = line.substr(0, line.find("  "));
        if (inside && (line.empty() || line.rfind("...", 0) == 0)) {
            break;
        }
        if (inside) {
            names.push_back(word);
        }
        inside = inside || line.rfind("best", 0) == 0;
    }
    return names;
}

/// Geometric means over the views of a number of the rows of results.json, by design.
std::map<std::string, double> means_of(const std::string& folder, const std::string& key) {
    const auto written = nlohmann::json::parse(read_file(folder + "/results.json"));
    std::map<std::string, double> logs;
    for (const auto& run : written["runs"]) {
        const auto& variant = written["variants"][run["variant"].get<std::size_t>()];
        logs[variant["name"]] += std::log(run[key].get<double>()) / 2;
    }
    return logs;
}

TEST(SweepRanking, SortsByMeansOverTheViews) {
    const Folder folder;
    const std::string file = ranked_study(folder);
    const Outcome all = sorted_sweep(file, folder / "o", {"latency_ms"});
    expect_success(all);
    const std::vector<std::string> names = ranked(all.out);
    ASSERT_EQ(names.size(), 6U) << all.out;
    const auto means = means_of(folder / "o", "latency_ms");
    for (std::size_t i = 1; i < names.size(); ++i) {
        EXPECT_LE(means.at(names[i - 1]), means.at(names[i])) << all.out;
    }
    const Outcome slowest = sorted_sweep(file, folder / "o", {"max:latency_ms", "--top", "2"});
    expect_success(slowest);
    EXPECT_EQ(ranked(slowest.out), (std::vector<std::string>{names[5], names[4]})) << slowest.out;
    EXPECT_THAT(slowest.out, HasSubstr("... and 4 more designs"));
}

TEST(SweepRanking, PutsDesignsThatBreakALimitBehindTheOthers) {
    const Folder folder;
    const std::string file = ranked_study(folder, "limits: span_share<=1e9, area_mm2<=2.7\n");
    const Outcome wrong = sorted_sweep(file, folder / "o", {"latency_ms"});
    EXPECT_NE(wrong.code, 0) << "a limit of a number that does not exist";
    const std::string right = ranked_study(folder, "limits: area_mm2<=2.7\n");
    const Outcome outcome = sorted_sweep(right, folder / "o", {"latency_ms*area_mm2"});
    expect_success(outcome);
    const std::vector<std::string> names = ranked(outcome.out);
    ASSERT_EQ(names.size(), 6U) << outcome.out;
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(names[i].find("span.count=2") != std::string::npos, i < 3) << outcome.out;
    }
    EXPECT_THAT(outcome.out, HasSubstr("within"));
}

TEST(HostileSweepRanking, RefusesWhatIsNoGoal) {
    const Folder folder;
    const std::string file = ranked_study(folder);
    const Outcome unknown = sorted_sweep(file, folder / "o", {"latency"});
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("--sort"));
    EXPECT_THAT(unknown.err, HasSubstr("latency_ms"));
    EXPECT_FALSE(fs::exists(folder / "o/points")) << "nothing has run";
    EXPECT_NE(degs({"sweep", file, "--top", "3"}).code, 0) << "without --sort";
}

} // namespace
} // namespace degs::sim_test
