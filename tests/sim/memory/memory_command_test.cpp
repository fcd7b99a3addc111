// SPDX-License-Identifier: Apache-2.0
// degs memory: what it measures, writes and refuses.
#include <algorithm>
#include <sstream>
#include <vector>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

std::string memory(const std::string& name) {
    return config("memory/" + name);
}

nlohmann::json measure(const std::string& name, std::vector<std::string> options) {
    const Folder folder;
    std::vector<std::string> arguments{"memory", memory(name), "--out", folder / "out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    if (std::find(options.begin(), options.end(), "--curve") == options.end()) {
        arguments.emplace_back("--no-curve");
    } else {
        arguments.erase(std::find(arguments.begin(), arguments.end(), "--curve"));
    }
    expect_success(degs(arguments));
    return nlohmann::json::parse(read_file(folder / "out/memory.json"));
}

double fraction(const nlohmann::json& written) {
    return written["bandwidth_fraction"].get<double>();
}

TEST(MemoryCommand, StreamsUseTheBus) {
    for (const char* name : {"lpddr5-6400x256", "lpddr5-6400x128", "lpddr5-3200x128"}) {
        const auto written = measure(name, {"--requests", "50000"});
        EXPECT_GE(fraction(written), 0.90) << name;
        EXPECT_LE(fraction(written), 0.947) << name << ": the refresh ceiling";
        EXPECT_NEAR(written["bandwidth_gb_per_s"].get<double>(),
                    fraction(written) * written["peak_gb_per_s"].get<double>(), 1e-6);
        EXPECT_GT(written["row_hit_rate"].get<double>(), 0.9);
    }
}

// The page's expectation for random 64 B at queues of 32 and 64; 8 entries lose a lot.
TEST(MemoryCommand, RandomTrafficNeedsDeepQueues) {
    double before = 0;
    for (const char* queue : {"8", "32", "64"}) {
        const auto written =
            measure("lpddr5-6400x256", {"--pattern", "random", "--requests", "50000", "--set",
                                        std::string("controller.read_queue=") + queue, "--set",
                                        std::string("controller.write_queue=") + queue});
        EXPECT_GE(fraction(written), before);
        EXPECT_LE(fraction(written), 0.80) << "five commands for four CK of data";
        EXPECT_GE(fraction(written), std::string(queue) == "8" ? 0.4 : 0.6);
        EXPECT_NEAR(written["row_hit_rate"].get<double>(), 0.5, 0.01) << "the second burst of each";
        EXPECT_NEAR(written["access_hit_rate"].get<double>(), 0.0, 0.01);
        before = fraction(written);
    }
}

/// The rows of docs/memories.csv: file and pattern, and percents of the peak.
std::vector<std::vector<std::string>> published_bandwidths() {
    std::istringstream lines(read_file(std::string(DEGS_CONFIGS) + "/../docs/memories.csv"));
    std::vector<std::vector<std::string>> rows;
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) {
            rows.back().push_back(cell);
        }
    }
    return rows;
}

// The page's bandwidths come out again, and with the same durations they are those of Ramulator.
TEST(MemoryCommand, BandwidthsAreThoseOfTheReferenceSimulator) {
    const auto rows = published_bandwidths();
    ASSERT_EQ(rows.size(), 10U);
    for (const auto& row : rows) {
        const auto written = measure(row[0], {"--pattern", row[1]});
        EXPECT_NEAR(100 * fraction(written), std::stod(row[2]), 0.06) << row[0] << ' ' << row[1];
        EXPECT_NEAR(std::stod(row[3]), std::stod(row[4]), 3) << row[0] << ' ' << row[1];
    }
}

// Every request of 64 B is two bursts; a saturated closed loop obeys Little's law.
TEST(MemoryCommand, CountsAddUp) {
    const auto written = measure("lpddr5-3200x128", {"--requests", "30000"});
    const auto& commands = written["commands"];
    const double bursts = commands["rd"].get<double>() + commands["rda"].get<double>();
    const double requests = written["traffic"]["requests"].get<double>();
    EXPECT_NEAR(bursts, 2 * requests, 0.01 * requests);
    EXPECT_EQ(commands["wr"].get<double>() + commands["wra"].get<double>(), 0);
    EXPECT_NEAR(commands["act1"].get<double>(), commands["act2"].get<double>(), 8);
    const double window = 32 + 3 + 1; // the queue, 11 CK of 4 CK each, and one
    EXPECT_NEAR(written["latency_ns"]["mean"].get<double>(),
                8 * window * 64 / written["bandwidth_gb_per_s"].get<double>(), 15);
    const auto& energy = written["energy"];
    EXPECT_NEAR(energy["read_nj"].get<double>(), 2.75e-3 * 256 * bursts, 1e-3 * bursts);
    EXPECT_GT(energy["background_nj"].get<double>(), 0);
}

TEST(MemoryCommand, WritesCostTurnarounds) {
    const double reads = fraction(measure("lpddr5-6400x256", {"--requests", "30000"}));
    const double mixed =
        fraction(measure("lpddr5-6400x256", {"--requests", "30000", "--reads-per-write", "3"}));
    EXPECT_LT(mixed, reads);
    EXPECT_GT(mixed, 0.70);
}

TEST(MemoryCommand, CurveRisesWithTheLoad) {
    const Folder folder;
    const Outcome outcome = degs({"memory", memory("lpddr5-3200x128"), "--pattern", "random",
                                  "--requests", "20000", "--out", folder / "out"});
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("offered %"), std::string::npos);
    const auto written = nlohmann::json::parse(read_file(folder / "out/memory.json"));
    const auto& curve = written["curve"];
    ASSERT_GE(curve.size(), 5U);
    for (std::size_t i = 1; i < curve.size(); ++i) {
        EXPECT_GT(curve[i]["latency_ns"]["mean"], curve[i - 1]["latency_ns"]["mean"]);
    }
    // Hardly loaded: a conflict or a closed row, and the second burst; 42 to 62 ns here.
    EXPECT_NEAR(curve[0]["latency_ns"]["mean"].get<double>(), 62, 20);
    EXPECT_NE(read_file(folder / "out/latency.svg").find("<svg"), std::string::npos);
}

TEST(MemoryCommand, GivesTheSameTwice) {
    auto first = measure("lpddr5-6400x128", {"--pattern", "random", "--reads-per-write", "1",
                                             "--requests", "5000", "--seed", "7", "--curve"});
    auto second = measure("lpddr5-6400x128", {"--pattern", "random", "--reads-per-write", "1",
                                              "--requests", "5000", "--seed", "7", "--curve"});
    first.erase("host");
    second.erase("host");
    EXPECT_EQ(first, second);
}

class HostileMemory
    : public ::testing::TestWithParam<std::pair<std::vector<std::string>, std::string>> {};

TEST_P(HostileMemory, IsOneSentence) {
    const Folder folder;
    std::vector<std::string> arguments{"memory"};
    arguments.insert(arguments.end(), GetParam().first.begin(), GetParam().first.end());
    arguments.insert(arguments.end(), {"--out", folder / "out"});
    expect_mistake(degs(arguments), GetParam().second);
}

using Case = std::pair<std::vector<std::string>, std::string>;
INSTANTIATE_TEST_SUITE_P(
    Mistakes, HostileMemory,
    ::testing::Values(Case{{}, "config"}, Case{{"no-such.yaml"}, "no-such.yaml"},
                      Case{{memory("lpddr5-6400x256"), "--pattern", "zigzag"}, "zigzag"},
                      Case{{memory("lpddr5-6400x256"), "--set", "controller.read_queue=65"}, "65"},
                      Case{{memory("lpddr5-6400x256"), "--requests", "0"}, "requests"},
                      Case{{memory("lpddr5-6400x256"), "--request-bytes", "0"}, "request-bytes"},
                      Case{{memory("lpddr5-6400x256"), "--set", "timing.rcd=0"}, "timing.rcd"},
                      Case{{memory("lpddr5-6400x256"), "--set", "timing.tRCD=15"}, "tRCD"},
                      Case{{memory("lpddr5-6400x256"), "--set", "mapping.order=row bank"}, "order"},
                      Case{{config("degs-64")}, "degs-64.yaml"}));

} // namespace
} // namespace degs::sim_test
