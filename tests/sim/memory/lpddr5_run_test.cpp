// SPDX-License-Identifier: Apache-2.0
// Trained scenes on LPDDR5: scattered records load all channels, and what the report says of the
// memory explains the cycles of a frame that memory limits.
#include <algorithm>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

json run_on(const std::string& memory, const std::string& configuration,
            const std::vector<std::string>& more = {}) {
    const Folder folder;
    std::vector<std::string> arguments{
        "run",           config(configuration),
        "--memory",      config("memory/" + memory),
        "--scene",       (trained_scenes() / "flowers" / "scene.ply").string(),
        "--camera",      "2",
        "--out",         folder / "out",
        "--no-reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(degs(arguments));
    return report_in(folder / "out");
}

bool no_scene() {
    return !fs::exists(trained_scenes() / "flowers" / "scene.ply");
}

class Lpddr5Run : public testing::TestWithParam<std::string> {};

TEST_P(Lpddr5Run, LoadsItsChannelsAlike) {
    if (no_scene()) {
        GTEST_SKIP() << "the trained scene flowers is not in " << trained_scenes();
    }
    const json report = run_on("lpddr5-6400x256", GetParam(), {"--width", "640"});
    const auto loads = report["dram"]["channels"]["bytes"].get<std::vector<std::uint64_t>>();
    ASSERT_EQ(loads.size(), 16U);
    const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
    EXPECT_LE(static_cast<double>(*most), 1.2 * static_cast<double>(*least));
    std::uint64_t sum = 0;
    for (const std::uint64_t load : loads) {
        sum += load;
    }
    EXPECT_EQ(report["dram"]["transfers"]["on_bus"], sum);
}
INSTANTIATE_TEST_SUITE_P(All, Lpddr5Run,
                         testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64"),
                         [](const auto& design) {
                             std::string name = design.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// The calculation of docs/memory.md.
TEST(Lpddr5Frame, BytesRowMissesAndLatencyExplainTheCycles) {
    if (no_scene()) {
        GTEST_SKIP() << "the trained scene flowers is not in " << trained_scenes();
    }
    const json report = run_on("lpddr5-3200x128", "degs-256");
    const json& dram = report["dram"];
    const json& did = dram["channels"];
    const auto channels = static_cast<double>(did["bytes"].size());
    constexpr double kCk = 2.5; // ns
    constexpr int kBanks = 16;
    constexpr int kRefresh = 84, kOpen = 8 + 8, kTurn = 8 + 12 - 2 * 2; // CK; docs/lpddr5.md
    const double bytes =
        dram["transfers"]["on_bus"].get<double>() / dram["peak_gb_per_s"].get<double>();
    const double misses =
        did["accesses"]["closed"].get<double>() + did["accesses"]["conflicts"].get<double>();
    const double rows = misses / channels * kOpen * kCk / kBanks;
    const double turns = did["write_batches"].get<double>() / channels * kTurn * kCk;
    const double refresh = did["commands"]["ref_ab"].get<double>() / channels * kRefresh * kCk;
    double latency = 0;
    for (const char* stream : {"geometry", "sh", "tile_lists_sorted", "splats_read"}) {
        latency += dram["streams"][stream]["read_latency_ns"]["mean"].get<double>();
    }
    const double cycles = report["timing"]["cycles"].get<double>(); // 1 GHz
    const double explained = bytes + rows + turns + refresh + latency;
    EXPECT_NEAR(explained / cycles, 1.0, 0.1) << bytes << " + " << rows << " + " << turns << " + "
                                              << refresh << " + " << latency << " of " << cycles;
}

} // namespace
} // namespace degs::sim_test
