// SPDX-License-Identifier: Apache-2.0
// degs run --fidelity analytic: near the simulation, inside its bounds, and following the design.
#include <set>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

std::string analytic_config(const std::string& name) {
    return std::string(DEGS_CONFIGS) + "/" + name + ".yaml";
}

json analytic_of(const std::string& config, const std::vector<std::string>& more) {
    const Folder folder;
    std::vector<std::string> arguments{"run",        config,  "--fidelity",  "analytic",
                                       "--no-cache", "--out", folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(degs(arguments));
    return json::parse(read_file(folder / "out/analytic.json"));
}

double cycles_of(const json& report) {
    return report["timing"]["cycles"];
}

const std::vector<std::string> kAnalyticView{"--scene", "synthetic:object,gaussians=4000",
                                             "--width", "320"};

std::vector<std::string> analytic_view_and(const std::vector<std::string>& more) {
    std::vector<std::string> all = kAnalyticView;
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

// The folder has the documents of the last command alone: an estimate has no image, and a report
// no estimate.
TEST(AnalyticFiles, ReplaceThoseOfARunAndTheOtherWayRound) {
    const Folder folder;
    const auto files_after = [&folder](const std::string& command, const std::string& fidelity) {
        std::vector<std::string> words{command, "--scene", "synthetic:single", "--width",
                                       "32",    "--out",   folder / "out"};
        if (command == "run") {
            words.insert(words.begin() + 1, config("degs-16"));
            words.insert(words.end(), {"--no-cache", "--fidelity", fidelity});
        }
        expect_success(degs(words));
        std::set<std::string> names;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / "out")) {
            names.insert(entry.path().filename().string());
        }
        return names;
    };
    using Names = std::set<std::string>;
    EXPECT_EQ(files_after("run", "exact"), (Names{"image.exr", "image.png", "report.json"}));
    EXPECT_EQ(files_after("run", "analytic"), Names{"analytic.json"});
    EXPECT_EQ(files_after("run", "exact"), (Names{"image.exr", "image.png", "report.json"}));
    EXPECT_EQ(files_after("run", "analytic"), Names{"analytic.json"});
    EXPECT_EQ(files_after("render", ""), (Names{"image.exr", "image.png", "render.json"}));
}

class Analytic : public testing::TestWithParam<std::string> {};

TEST_P(Analytic, IsNearTheSimulation) {
    const Folder folder;
    std::vector<std::string> arguments{
        "run",         analytic_config(GetParam()), "--no-reference", "--no-cache", "--out",
        folder / "out"};
    arguments.insert(arguments.end(), kAnalyticView.begin(), kAnalyticView.end());
    expect_success(degs(arguments));
    const json exact = json::parse(read_file(folder / "out/report.json"));
    const json estimate = analytic_of(analytic_config(GetParam()), kAnalyticView);
    const double cycles = cycles_of(exact);
    EXPECT_NEAR(cycles_of(estimate), cycles, 0.1 * cycles);
    const double before = exact["timing"]["preprocessing_cycles"];
    EXPECT_NEAR(estimate["timing"]["preprocessing_cycles"], before, 0.1 * before);
    EXPECT_NEAR(estimate["slots"]["utilization"], exact["slots"]["utilization"], 0.1);
    const double bytes =
        exact["dram"]["bytes_read"].get<double>() + exact["dram"]["bytes_written"].get<double>();
    EXPECT_NEAR(estimate["dram"]["bytes"], bytes, 0.16 * bytes); // without GBU's reuse cache
    for (const char* part : {"nj_per_frame", "dynamic_nj", "leakage_nj", "dram_nj"}) {
        const double energy = exact["energy"][part];
        EXPECT_NEAR(estimate["energy"][part], energy, 0.12 * energy) << part;
    }
    EXPECT_EQ(estimate["energy"]["blocks"].size(), exact["energy"]["blocks"].size());
    EXPECT_EQ(estimate["workload"]["tile_pairs"], exact["workload"]["tile_pairs"]);
}

TEST_P(Analytic, LiesBetweenItsBounds) {
    const json report = analytic_of(analytic_config(GetParam()), kAnalyticView);
    EXPECT_LE(report["timing"]["lower_cycles"], report["timing"]["cycles"]);
    EXPECT_GT(report["timing"]["lower_cycles"], 0);
    EXPECT_GE(report["timing"]["upper_cycles"], report["timing"]["lower_cycles"]);
    EXPECT_TRUE(report["units"].contains(report["limited_by"].get<std::string>()));
    EXPECT_LE(report["slots"]["utilization"], 1);
    const json& sample = report["sample"];
    const double error = sample["standard_error"];
    EXPECT_LT(error, 0.2);
    EXPECT_EQ(error == 0, sample["tiles_drawn"] == sample["tiles"]) << error;
}

TEST_P(Analytic, IsTheSameEveryTime) {
    json first = analytic_of(analytic_config(GetParam()), kAnalyticView);
    json second = analytic_of(analytic_config(GetParam()), kAnalyticView);
    first.erase("host");
    second.erase("host");
    EXPECT_EQ(first, second);
}

TEST_P(Analytic, CostsWhatTheSimulatedDesignCosts) {
    const json area = analytic_of(analytic_config(GetParam()), kAnalyticView)["area"];
    const Outcome printed =
        degs({"config", analytic_config(GetParam()), "--cost", "--format", "json"});
    expect_success(printed);
    EXPECT_EQ(area, json::parse(printed.out)["area"]);
}

// A bus of 2 GB/s moves two bytes per cycle, which then takes longer than everything else.
TEST_P(Analytic, FollowsTheMemory) {
    const json report = analytic_of(analytic_config(GetParam()),
                                    analytic_view_and({"--set", "memory.bandwidth_gb_per_s=2"}));
    EXPECT_EQ(report["limited_by"], "memory");
    EXPECT_GE(cycles_of(report), report["dram"]["bytes"].get<double>() / 2);
}

TEST_P(Analytic, TakesAnEmptyFrameAndASinglePixel) {
    for (const std::vector<std::string>& view :
         {std::vector<std::string>{"--scene", "synthetic:object,gaussians=1", "--width", "1"},
          std::vector<std::string>{"--scene", "synthetic:object,gaussians=1", "--width", "2000"}}) {
        const json report = analytic_of(analytic_config(GetParam()), view);
        EXPECT_GT(cycles_of(report), 0);
        // Each of its many tiles of 8 px is a product that fills and drains the array.
        const double most = GetParam() == "orange-o1" ? 1e7 : 1e6;
        EXPECT_LT(cycles_of(report), most);
    }
}

INSTANTIATE_TEST_SUITE_P(Designs, Analytic,
                         testing::Values("degs-64", "degs-64-tuned", "gscore-64", "gbu-64",
                                         "gcc-64", "orange-o1"),
                         [](const auto& design) {
                             std::string name = design.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

class AnalyticChange : public testing::TestWithParam<std::pair<std::string, std::string>> {};

// Estimates of both designs rest on the same tiles.
TEST_P(AnalyticChange, GainsWhatRunsGain) {
    const auto& [design, change] = GetParam();
    const Folder folder;
    const auto cycles_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "run",   analytic_config(design), "--no-reference", "--no-cache",
            "--out", folder / "out"};
        arguments.insert(arguments.end(), kAnalyticView.begin(), kAnalyticView.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_success(degs(arguments));
        return cycles_of(json::parse(read_file(folder / "out/report.json")));
    };
    const double after = cycles_with({"--set", change});
    const double before = cycles_with({"--what-if", change});
    const json estimate = json::parse(read_file(folder / "out/report.json"))["what_if"][0];
    EXPECT_NEAR(estimate["change"], after / before - 1, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Changes, AnalyticChange,
                         testing::Values(std::pair{"degs-64", "span.count=16"},
                                         std::pair{"degs-64", "slicing.count=1"},
                                         std::pair{"gscore-64", "array.subtile_skip=exact"},
                                         std::pair{"orange-o1", "cores.array.fill=none"},
                                         std::pair{"gbu-64", "engines.queue_depth=1"},
                                         std::pair{"gbu-64", "engines.count=4"},
                                         std::pair{"gcc-64", "memory.bandwidth_gb_per_s=25.6"}),
                         [](const auto& change) {
                             std::string name = change.param.first + "_" + change.param.second;
                             std::replace_if(
                                 name.begin(), name.end(),
                                 [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                             return name;
                         });

TEST(AnalyticCommand, FollowsTheSizeOfTheArray) {
    double before = 1e12;
    for (const std::string size : {"16", "64", "256"}) {
        const double cycles =
            cycles_of(analytic_of(analytic_config("degs-" + size), kAnalyticView));
        EXPECT_LT(cycles, before) << size;
        before = cycles;
    }
}

// Now memory, now projection and now binning are the slowest in this scene.
TEST(AnalyticCommand, PreparesAsASimulationDoes) {
    const std::vector<std::string> view{"--scene", "synthetic:object,gaussians=60000", "--width",
                                        "640"};
    for (const std::string rate : {"51.2", "409.6"}) {
        const Folder folder;
        std::vector<std::string> more = view;
        more.insert(more.end(), {"--set", "memory.bandwidth_gb_per_s=" + rate});
        std::vector<std::string> arguments{
            "run",         analytic_config("gscore-64"), "--no-reference", "--no-cache", "--out",
            folder / "out"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_success(degs(arguments));
        const json exact = json::parse(read_file(folder / "out/report.json"))["timing"];
        const json estimate = analytic_of(analytic_config("gscore-64"), more)["timing"];
        const double cycles = exact["preprocessing_cycles"];
        EXPECT_NEAR(estimate["preprocessing_cycles"], cycles, 0.03 * cycles) << rate;
    }
}

// Two of the four tiles fill the bound on what is drawn, and they are not typical.
TEST(AnalyticCommand, DrawsSeveralTilesOfAFewLongLists) {
    const Folder folder;
    const std::vector<std::string> view{"--scene", "synthetic:object,gaussians=60000", "--width",
                                        "640"};
    std::vector<std::string> arguments{
        "run", analytic_config("gcc-256"), "--no-reference", "--no-cache", "--out", folder / "out"};
    arguments.insert(arguments.end(), view.begin(), view.end());
    expect_success(degs(arguments));
    const double cycles = cycles_of(json::parse(read_file(folder / "out/report.json")));
    EXPECT_NEAR(cycles_of(analytic_of(analytic_config("gcc-256"), view)), cycles, 0.2 * cycles);
    for (const std::string design : {"degs-1024", "gscore-1024", "gbu-1024", "gcc-256"}) {
        const json sample = analytic_of(analytic_config(design), view)["sample"];
        EXPECT_GE(sample["tiles_drawn"], std::min<int>(8, sample["tiles"])) << design;
    }
}

TEST(AnalyticCommand, FitsTheTerminal) {
    const Folder folder;
    const Outcome outcome =
        degs({"run", analytic_config("degs-64"), "--scene", "synthetic:object,gaussians=4000",
              "--width", "320", "--fidelity", "analytic", "--out", folder / "out"},
             [] { ::setenv("COLUMNS", "80", 1); });
    expect_success(outcome);
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 80U) << line;
    }
    EXPECT_NE(outcome.out.find("takes about"), std::string::npos) << outcome.out;
}

TEST(AnalyticCommand, RefusesWhatNeedsASimulation) {
    const Folder folder;
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--within", "1%"},
                                                 {"--array-only"},
                                                 {"--frames", "2"},
                                                 {"--maps", folder / "maps"},
                                                 {"--trace", folder / "trace"},
                                                 {"--explain"}}) {
        std::vector<std::string> arguments{
            "run", analytic_config("degs-64"), "--fidelity", "analytic", "--out", folder / "out"};
        arguments.insert(arguments.end(), kAnalyticView.begin(), kAnalyticView.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = degs(arguments);
        EXPECT_NE(outcome.code, 0);
        EXPECT_NE(outcome.err.find(more.front() + " needs a simulation"), std::string::npos)
            << outcome.err;
    }
}

} // namespace
} // namespace degs::sim_test
