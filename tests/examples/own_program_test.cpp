// SPDX-License-Identifier: Apache-2.0
// examples/own-accelerator as the program that a user has: every command works with its
// accelerator.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "config.hpp"
#include "tests/sim/process/child.hpp"
#include "tests/sim/report/advice.hpp"

namespace degs::sim_test {
namespace {

const char* const kScene = "synthetic:object,gaussians=2000";
/// As config() takes it: beside the designs of this project.
const char* const kDesign = "../examples/own-accelerator/row-sweep-64";

using Arguments = std::vector<std::string>;

Arguments with(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// `degs run` on a small view, into the folder `out` of another.
Outcome run(const Folder& folder, const Arguments& more, const char* width = "240") {
    return degs(
        with({"run", config(kDesign), "--scene", kScene, "--width", width, "--out", folder / "out"},
             more));
}

double cycles_of(const nlohmann::json& report) {
    return report["timing"]["cycles"].get<double>();
}

nlohmann::json json_of(const std::string& file) {
    return nlohmann::json::parse(read_file(file));
}

TEST(OwnProgram, RendersTheReferenceInEitherFidelity) {
    const Folder exact, strict;
    ASSERT_EQ(run(exact, {}).code, 0);
    ASSERT_EQ(run(strict, {"--fidelity", "strict"}).code, 0);
    const nlohmann::json report = report_in(exact / "out"), other = report_in(strict / "out");
    EXPECT_EQ(report["config"]["accelerator"], "row_sweep");
    EXPECT_GT(report["image"]["psnr_db"].get<double>(), 100);
    for (const char* const part : {"timing", "slots", "stages", "buffers", "dram", "losses"}) {
        EXPECT_EQ(report[part], other[part]) << part;
    }
    EXPECT_EQ(report["image"]["crc32"], other["image"]["crc32"]);
}

TEST(OwnProgram, EstimatesTheFrame) {
    const Folder folder;
    ASSERT_EQ(run(folder, {"--no-reference"}).code, 0);
    const double cycles = cycles_of(report_in(folder / "out"));
    ASSERT_EQ(run(folder, {"--fidelity", "analytic"}).code, 0);
    const nlohmann::json estimate = json_of(folder / "out/analytic.json");
    EXPECT_NEAR(cycles_of(estimate) / cycles, 1, 0.1) << estimate;
}

TEST(OwnProgram, SamplesTiles) {
    const Folder folder;
    // The frame uses 29 % of the design's memory, which is more than a sample may.
    const Arguments options{"--no-reference", "--set", "memory.bandwidth_gb_per_s=409.6"};
    ASSERT_EQ(run(folder, options, "1920").code, 0);
    const double cycles = cycles_of(report_in(folder / "out"));
    const Outcome sampled = run(folder, with(options, {"--fidelity", "sampled:30%"}), "1920");
    ASSERT_EQ(sampled.code, 0) << sampled.err;
    const nlohmann::json report = report_in(folder / "out");
    EXPECT_LT(report["sampling"]["tiles_measured"],
              0.4 * report["sampling"]["tiles"].get<double>());
    EXPECT_NEAR(cycles_of(report) / cycles, 1, 0.05);
}

TEST(OwnProgram, IsComparedWithDegs) {
    const Folder folder;
    const Outcome outcome = degs({"compare", config("degs-64"), config(kDesign), "--scene", kScene,
                                  "--width", "240", "--out", folder / "out"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("row-sweep-64"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("degs-64"), std::string::npos) << outcome.out;
}

/// A study of two sizes of the family.
std::string study_in(const Folder& folder) {
    std::ofstream(folder / "study.yaml")
        << "study: sizes\ndesigns:\n  - include: " << fs::canonical(config(kDesign)).string()
        << "\naxes:\n  arrays.count: [2, 4]\nscenes: " << kScene
        << "\nwidth: 240\nreference: false\n";
    return folder / "study.yaml";
}

TEST(OwnProgram, SweepsAndExplores) {
    const Folder folder;
    const Outcome swept = degs({"sweep", study_in(folder), "--out", folder / "sweep"});
    ASSERT_EQ(swept.code, 0) << swept.err;
    const Outcome explored = degs({"explore", study_in(folder), "--out", folder / "explore"});
    ASSERT_EQ(explored.code, 0) << explored.err;
    EXPECT_NE(explored.out.find("row-sweep-64"), std::string::npos) << explored.out;
}

TEST(OwnProgram, RendersOnAPlatform) {
    const Folder folder;
    const Outcome outcome = degs({"soc", config(kDesign), "--scene", kScene, "--width", "120",
                                  "--load", "5", "--out", folder / "out"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(folder / "out/soc.json"));
}

/// PE-cycles by class as a viewer sums them up: a counter holds its value until its next event.
std::map<std::string, double> slots_in(const nlohmann::json& trace) {
    std::map<std::string, double> sums, dates, values;
    for (const nlohmann::json& event : trace["traceEvents"]) {
        if (event["ph"] == "C") {
            const std::string name = event["name"];
            const double date = event["ts"].get<double>() * 1e3; // in cycles at 1 GHz
            sums[name] += values[name] * (date - dates[name]);
            dates[name] = date;
            values[name] = event["args"]["value"];
        }
    }
    return sums;
}

TEST(OwnProgram, WritesATimelineAndMaps) {
    const Folder folder;
    const Outcome outcome = run(
        folder, {"--no-reference", "--trace", folder / "trace.json", "--maps", folder / "maps"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string text = read_file(folder / "trace.json");
    EXPECT_NE(text.find("\"array_0\""), std::string::npos);
    std::map<std::string, double> slots = slots_in(nlohmann::json::parse(text));
    const nlohmann::json report = report_in(folder / "out");
    for (const char* const slot : {"useful", "boundary", "terminated", "starved", "drain"}) {
        EXPECT_NEAR(slots[slot], report["slots"][slot].get<double>(), 0.5) << slot;
    }
    EXPECT_GT(std::distance(fs::directory_iterator(folder / "maps"), fs::directory_iterator()), 10);
}

TEST(OwnProgram, ExplainsKeysStatisticsAndCosts) {
    const std::string keys = degs({"config", "row_sweep"}).out;
    EXPECT_NE(keys.find("skip_ended"), std::string::npos) << keys;
    EXPECT_NE(keys.find("cost.row_sweep"), std::string::npos) << keys;
    const std::string statistics = degs({"config", config(kDesign), "--stats"}).out;
    EXPECT_NE(statistics.find("splats_abandoned"), std::string::npos) << statistics;
    const std::string costs = degs({"config", config(kDesign), "--cost"}).out;
    EXPECT_NE(costs.find("blending"), std::string::npos) << costs;
    const std::string family = degs({"config", "row_sweep", "--pes", "128"}).out;
    EXPECT_NE(family.find("name: \"row-sweep-128\""), std::string::npos) << family;
}

TEST(OwnProgram, NamesMistakes) {
    const Folder folder;
    expect_mistake(run(folder, {"--set", "arrays.cuont=2"}), "arrays.count");
    expect_mistake(run(folder, {"--set", "tile_size=32"}), "pixel_buffer.bytes");
    expect_mistake(run(folder, {"--set", "accelerator=row_swep"}), "row_sweep");
    expect_mistake(run(folder, {"--set", "buffer.bytes=256"}), "must be at least 4096");
}

/// Keys of a situation that are named for their cause and lower its loss.
struct Advised {
    std::string cause, key;
    Settings settings;
    int width = 240;
};

void PrintTo(const Advised& advised, std::ostream* out) {
    *out << advised.cause << ": " << advised.key;
}

/// One for each key that the accelerator adds to those of all accelerators.
std::vector<Advised> advised() {
    const Settings late_writes{"memory.latency_ns=500", "pixel_buffer.writes_in_flight=1",
                               "pixel_buffer.bytes=4096", "fetching.chunks_in_flight=64",
                               "buffer.chunks=8"};
    return {
        {"terminated", "arrays.skip_ended", {}},
        {"answers", "fetching.chunks_in_flight and buffer.chunks", {"memory.latency_ns=1000"}},
        {"blocked", "pixel_buffer.bytes", {"pixel_buffer.readout_pixels=1"}},
        {"blocked", "pixel_buffer.readout_pixels", {"pixel_buffer.readout_pixels=1"}},
        {"acknowledgements", "pixel_buffer.writes_in_flight", late_writes},
        {"acknowledgements", "pixel_buffer.bytes", late_writes},
        {"readout", "pixel_buffer.readout_pixels", {"pixel_buffer.readout_pixels=1"}, 64},
    };
}

TEST(OwnProgram, HasASituationForEveryKeyOfItsOwn) {
    const row_sweep::Config config;
    std::set<std::pair<std::string, std::string>> own, tried;
    for (const LossKey& key : config.loss_keys()) {
        own.insert({key.cause, key.name()});
    }
    for (const LossKey& key : common_loss_keys(config.memory)) {
        own.erase({key.cause, key.name()});
    }
    for (const Advised& each : advised()) {
        tried.insert({each.cause, each.key});
    }
    EXPECT_EQ(own, tried);
}

class OwnAdvice : public ::testing::TestWithParam<Advised> {};

TEST_P(OwnAdvice, LowersTheLoss) {
    const Advised& advised = GetParam();
    const AdvisedView view{kDesign, advised.settings, advised.width};
    const auto before = report_with(view);
    ASSERT_TRUE(before);
    std::string failure = "not named: " + (*before)["losses"].dump(1);
    for (const auto& loss : (*before)["losses"]) {
        for (const std::string advice : loss["keys"]) {
            if (advice.find(advised.key) != std::string::npos && failure != "") {
                failure = failure_of(advice, loss["reason"], view, *before);
            }
        }
    }
    EXPECT_EQ(failure, "");
}

INSTANTIATE_TEST_SUITE_P(Keys, OwnAdvice, ::testing::ValuesIn(advised()), [](const auto& advised) {
    std::string name = advised.param.cause + "_" + advised.param.key;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '.' || c == ' '; }, '_');
    return name;
});

} // namespace
} // namespace degs::sim_test
