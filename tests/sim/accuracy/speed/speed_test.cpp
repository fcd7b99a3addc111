// SPDX-License-Identifier: Apache-2.0
// degs accuracy --speed: rows, groups and refusals.
#include "sim/accuracy/speed/speed.hpp"

#include <algorithm>
#include <set>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

const std::string kSpeedScene = "synthetic:object,gaussians=3000";

json speed_of(const Folder& folder, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"accuracy", "--scene", kSpeedScene,    "--camera",
                                       "1",        "--out",   folder / "out", "--speed"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = degs(arguments);
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("intervals hold"), std::string::npos) << outcome.out;
    return json::parse(read_file(folder / "out/speed.json"));
}

std::vector<json> rows_with(const json& speed, const std::string& fidelity,
                            const std::string& numbers) {
    std::vector<json> found;
    for (const json& row : speed["rows"]) {
        if (row["fidelity"] == fidelity && row["numbers"] == numbers) {
            found.push_back(row);
        }
    }
    return found;
}

TEST(LongSpeedCommand, MeasuresEveryFidelityInEveryNumberSet) {
    const Folder folder;
    const json speed = speed_of(folder, {std::string(DEGS_CONFIGS) + "/degs-64.yaml", "--seeds",
                                         "2", "--fidelities", "strict,exact,within:5%"});
    EXPECT_GT(speed["view"]["fragments"], 0);
    EXPECT_EQ(speed["rows"].size(), 3U * (1 + 1 + 2));
    const std::set<std::string> keys{"accelerator",    "fidelity",     "numbers",
                                     "seed",           "sim_s",        "over_render",
                                     "cycles",         "cycles_error", "utilization_error",
                                     "dram_error",     "identical",    "psnr_db",
                                     "share",          "interval_low", "interval_high",
                                     "fragments_per_s"};
    for (const json& row : speed["rows"]) {
        std::set<std::string> present;
        for (const auto& [key, value] : row.items()) {
            present.insert(key);
        }
        EXPECT_EQ(present, keys);
        EXPECT_EQ(row["accelerator"], "degs-64");
        EXPECT_GT(row["sim_s"], 0);
        EXPECT_GT(row["over_render"], 0);
    }
    for (const std::string numbers : {"ideal", "fp32", "paper"}) {
        const json strict = rows_with(speed, "strict", numbers).at(0);
        const json exact = rows_with(speed, "exact", numbers).at(0);
        for (const char* same : {"cycles", "utilization_error", "dram_error", "psnr_db"}) {
            EXPECT_EQ(strict[same], exact[same]) << same;
        }
    }
    const json truth = rows_with(speed, "strict", "ideal").at(0);
    EXPECT_EQ(truth["cycles_error"], 0);
    EXPECT_EQ(truth["utilization_error"], 0);
    EXPECT_EQ(truth["dram_error"], 0);
    EXPECT_TRUE(truth["identical"]);
    EXPECT_TRUE(rows_with(speed, "exact", "ideal").at(0)["identical"]);
    const json paper = rows_with(speed, "exact", "paper").at(0);
    EXPECT_FALSE(paper["identical"]);
    EXPECT_GT(paper["psnr_db"], 40);
    EXPECT_LT(paper["psnr_db"], rows_with(speed, "exact", "fp32").at(0)["psnr_db"]);
    EXPECT_NE(read_file(folder / "out/speed.svg").find("within:5%"), std::string::npos);
}

TEST(SpeedCommand, GivesSamplesTheirIntervals) {
    const Folder folder;
    const json speed =
        speed_of(folder, {std::string(DEGS_CONFIGS) + "/gscore-64.yaml", "--numbers", "ideal",
                          "--seeds", "2", "--fidelities", "exact,sampled:40%", "--resolution",
                          "720p", "--set", "memory.bandwidth_gb_per_s=409.6"});
    ASSERT_EQ(speed["rows"].size(), 3U); // ideal once, although --numbers names it as well
    std::uint64_t seed = 0;
    for (const json& row : rows_with(speed, "sampled:40%", "ideal")) {
        EXPECT_EQ(row["seed"], ++seed);
        EXPECT_TRUE(row["psnr_db"].is_null());
        EXPECT_LT(row["interval_low"], row["cycles"]);
        EXPECT_GT(row["interval_high"], row["cycles"]);
        EXPECT_GE(row["share"], 0.4);
        EXPECT_LT(row["share"], 0.7);
    }
    ASSERT_EQ(speed["intervals"].size(), 1U);
    EXPECT_EQ(speed["intervals"][0]["sampled"], 2);
}

TEST(SpeedCommand, RefusesMistakesBeforeItRuns) {
    const std::string config = std::string(DEGS_CONFIGS) + "/degs-64.yaml";
    const auto refusal = [](const std::vector<std::string>& more) {
        const Folder folder;
        std::vector<std::string> arguments{"accuracy", "--out", folder / "out"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = degs(arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_TRUE(outcome.out.empty()) << outcome.out;
        return outcome.err;
    };
    EXPECT_NE(refusal({"--speed", config}).find("one --scene"), std::string::npos);
    EXPECT_NE(refusal({"--speed", config, "--scene", kSpeedScene + ",seed=1," + kSpeedScene})
                  .find("one --scene"),
              std::string::npos);
    EXPECT_NE(refusal({"--speed", config, "--scene", kSpeedScene, "--fidelities", "nearly"})
                  .find("'nearly'"),
              std::string::npos);
    EXPECT_NE(refusal({"--speed", config, "--scene", kSpeedScene, "--numbers", "fp7"}).find("fp7"),
              std::string::npos);
    EXPECT_NE(refusal({"--speed", "none.yaml", "--scene", kSpeedScene}).find("none.yaml"),
              std::string::npos);
    EXPECT_NE(refusal({"--seeds", "3", "--scene", kSpeedScene}).find("--speed"), std::string::npos);
}

sim::SpeedRow sample(std::uint64_t seed, double cycles, double low, double high) {
    sim::SpeedRow row;
    row.accelerator = "a";
    row.fidelity = "within:1%";
    row.numbers = "fp32";
    row.seed = seed;
    row.cycles = cycles;
    row.cycles_error = cycles / 200 - 1;
    row.over_render = static_cast<double>(seed);
    row.share = 0.1;
    row.interval_low = low;
    row.interval_high = high;
    return row;
}

TEST(SpeedGroups, CountIntervalsThatHoldTheExactCycles) {
    sim::SpeedRow exact = sample(1, 100, 0, 0);
    exact.fidelity = "exact";
    exact.seed.reset();
    exact.share.reset();
    sim::SpeedRow fallen = sample(4, 100, 0, 0);
    fallen.share.reset();
    const std::vector<sim::SpeedGroup> groups = sim::speed_groups(
        {exact, sample(1, 101, 99, 103), sample(2, 90, 88, 92), sample(3, 100, 100, 100), fallen});
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_EQ(groups[0].runs, 1U);
    EXPECT_EQ(groups[0].sampled, 0U);
    EXPECT_EQ(groups[1].runs, 4U);
    EXPECT_EQ(groups[1].sampled, 3U);
    EXPECT_EQ(groups[1].held, 2U);
    EXPECT_DOUBLE_EQ(groups[1].over_render, 2.5);
    EXPECT_DOUBLE_EQ(groups[1].cycles_error, 0.5); // of 0.495, 0.5, 0.5 and 0.55
}

} // namespace
} // namespace degs::sim_test
