// SPDX-License-Identifier: Apache-2.0
// Runs from a sample of the tiles: against exact runs, and what cannot be sampled.
#include <algorithm>
#include <cmath>

#include "sim/sampling/amounts.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

/// A frame of 1200 tiles of 16 px, of 300 tiles of 32 px.
std::vector<std::string> small_run(const std::string& name, const std::string& out,
                                   const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "run",      config(name), "--scene",       "synthetic:object,gaussians=6000",
        "--camera", "2",          "--width",       "768",
        "--out",    out,          "--no-reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

const std::vector<std::string> kFed{"--set", "memory.bandwidth_gb_per_s=409.6"};

/// A small run with twice the memory, so that it stays below the share of its peak that a sample
/// allows.
std::vector<std::string> fed_run(const std::string& name, const std::string& out,
                                 const std::vector<std::string>& more) {
    std::vector<std::string> words = small_run(name, out, kFed);
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

json sampled_report_of(const std::string& name, const std::vector<std::string>& more) {
    const Folder folder;
    const Outcome outcome = degs(fed_run(name, folder / "out", more));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return report_in(folder / "out");
}

double number(const json& report, const std::string& path) {
    json place = report;
    std::istringstream parts(path);
    for (std::string part; std::getline(parts, part, '.');) {
        place = place.at(part);
    }
    return place.get<double>();
}

class SampledRun : public ::testing::TestWithParam<const char*> {};

TEST_P(SampledRun, AgreesWithTheExactRun) {
    const json exact = sampled_report_of(GetParam(), {});
    const json sample = sampled_report_of(GetParam(), {"--fidelity", "sampled:40%"});
    const json& facts = sample["sampling"];
    EXPECT_EQ(sample["host"]["fidelity"], "sampled");
    EXPECT_FALSE(exact.contains("sampling"));
    EXPECT_GE(facts["tiles_measured"], 0.4 * facts["tiles"].get<double>());
    EXPECT_LT(facts["tiles_measured"], 0.7 * facts["tiles"].get<double>());
    for (const char* path : {"timing.cycles", "slots.useful", "slots.terminated", "energy.total_nj",
                             "dram.bytes_read", "dram.bytes_written", "slots.utilization"}) {
        json interval = facts["intervals"];
        std::istringstream parts(path);
        for (std::string part; std::getline(parts, part, '.');) {
            interval = interval.at(part);
        }
        const double value = number(exact, path);
        // A sample of its kind misses in one case of twenty; four half-widths are missed by a
        // mistake.
        const double half = (interval[1].get<double>() - interval[0].get<double>()) / 2;
        EXPECT_NEAR(number(sample, path), value, std::max(2 * half, 0.004 * value)) << path;
        EXPECT_LT(half, 0.2 * value) << path;
    }
    // Known without a sample.
    EXPECT_EQ(sample["timing"]["preprocessing_cycles"], exact["timing"]["preprocessing_cycles"]);
    EXPECT_EQ(sample["dram"]["streams"]["frame_buffer"], exact["dram"]["streams"]["frame_buffer"]);
    EXPECT_EQ(sample["workload"]["tile_pairs"], exact["workload"]["tile_pairs"]);
    // The laws of a report hold for what was estimated, too.
    double sum = 0;
    for (const char* part : {"useful", "boundary", "terminated", "conflict", "ports", "padding",
                             "starved", "blocked", "drain"}) {
        sum += number(sample, std::string("slots.") + part);
    }
    EXPECT_EQ(sum, number(sample, "slots.total"));
    EXPECT_EQ(sum, number(sample, "slots.pes") * number(sample, "timing.blending_cycles"));
}

// A sample that takes in every run of tiles has no scatter: what is left is what their order costs.
TEST_P(SampledRun, CostsNothingInAnotherOrder) {
    const double exact = number(sampled_report_of(GetParam(), {}), "timing.cycles");
    const json all = sampled_report_of(GetParam(), {"--fidelity", "sampled:99.9%"});
    EXPECT_EQ(all["sampling"]["tiles_measured"], all["sampling"]["tiles"]);
    // A third of what intervals allow for it. Other seeds of degs-64 take 1e-4 to 1.1e-3 more.
    EXPECT_NEAR(number(all, "timing.cycles"), exact, 1e-3 * exact);
}

INSTANTIATE_TEST_SUITE_P(Designs, SampledRun, ::testing::Values("degs-64", "gscore-64", "degs-16"));

TEST(SampledRunOnce, FollowsItsSeedAndNothingElse) {
    const auto numbers = [](const std::string& seed) {
        json report = sampled_report_of("gscore-64", {"--fidelity", "sampled:30%", "--seed", seed});
        report.erase("host");
        return report;
    };
    const json first = numbers("3");
    EXPECT_EQ(first, numbers("3"));
    EXPECT_NE(first["slots"], numbers("4")["slots"]);
}

TEST(SmallRunSampledOnce, IsOfTheTilesThatListASplat) {
    const Folder folder;
    std::vector<std::string> run =
        fed_run("gscore-64", folder / "out", {"--fidelity", "sampled:20%"});
    std::replace(run.begin(), run.end(), std::string("2"), std::string("0")); // the camera
    expect_success(degs(run));
    const json report = report_in(folder / "out");
    EXPECT_GT(number(report, "workload.empty_tiles"), 0);
    EXPECT_EQ(number(report, "sampling.tiles"),
              number(report, "workload.tiles") - number(report, "workload.empty_tiles"));
}

TEST(SmallRunSampledOnce, StopsWithinTheError) {
    const json report = sampled_report_of("gscore-64", {"--within", "5%"});
    const json& facts = report["sampling"];
    EXPECT_LE(facts["reached"], 0.05);
    EXPECT_EQ(facts["within"], 0.05);
    const json& interval = facts["intervals"]["timing"]["cycles"];
    const double half = (interval[1].get<double>() - interval[0].get<double>()) / 2;
    EXPECT_NEAR(half / number(report, "timing.cycles"), facts["reached"].get<double>(), 1e-9);
    EXPECT_EQ(sampled_report_of("gscore-64", {"--within", "useful:5%"})["sampling"]["measure"],
              "slots.useful");
}

/// The run is exact, and one warning says why.
void expect_exact(const std::vector<std::string>& more, const std::string& words) {
    const Folder folder;
    const Outcome plain = degs(fed_run("gscore-64", folder / "plain", {}));
    std::vector<std::string> arguments = fed_run("gscore-64", folder / "out", {});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = degs(arguments);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    // The address sanitizer adds lines of its own when a process ends behind a simulation.
    const std::size_t warning = outcome.err.find("degs: ");
    EXPECT_NE(warning, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("degs: ", warning + 1), std::string::npos) << outcome.err;
    json expected = report_in(folder / "plain"), report = report_in(folder / "out");
    EXPECT_EQ(report["warnings"].size(), 1U);
    for (const char* part : {"host", "warnings"}) {
        expected.erase(part);
        report.erase(part);
    }
    EXPECT_EQ(report, expected);
    EXPECT_EQ(read_file(folder / "out/image.exr"), read_file(folder / "plain/image.exr"));
}

TEST(SmallRunSampledOnce, IsExactWhereASampleCannotBeNarrowEnough) {
    expect_exact({"--within", "0.3%"}, "no sample is as narrow as was asked for");
}

// The run says what it has reached, and does not begin anew.
TEST(SmallRunSampledOnce, EndsWhereAnExactRunTakesNoLonger) {
    const Folder folder;
    const Outcome outcome = degs(fed_run("gscore-64", folder / "out", {"--within", "0.32%"}));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("beyond which an exact run takes no longer"), std::string::npos)
        << outcome.err;
    const json facts = report_in(folder / "out")["sampling"];
    EXPECT_GT(facts["reached"], 0.0032);
    const double share = number(facts, "tiles_simulated") / number(facts, "tiles");
    EXPECT_GE(share, 0.4);
    EXPECT_LE(share, 0.5); // by a group and the last tiles
}

TEST(SampledRunOnce, IsExactWhereTilesDependOnEachOther) {
    const std::pair<const char*, std::vector<std::string>> designs[] = {
        {"clusters=1", {"degs-64", "clusters=2"}},
        {"clusters=1", {"gcc-64", "clusters=2"}},
        {"clusters=1", {"gscore-64", "clusters=2"}},
        {"clusters=1", {"degs-x-256"}},
        {"slicing.interleave=1", {"degs-64-tuned"}},
        {"cores.count=1", {"orange-o2"}},
        {"front.cache_bytes=0", {"degs-x-256", "clusters=1"}},
        {"front.multicast_window=0",
         {"degs-64", "front.fifo_splats=64", "front.multicast_window=64"}}};
    for (const auto& [remedy, design] : designs) {
        SCOPED_TRACE(design.back());
        const Folder folder;
        std::vector<std::string> more{"--within", "5%"};
        for (std::size_t i = 1; i < design.size(); ++i) {
            more.insert(more.end(), {"--set", design[i]});
        }
        const Outcome outcome = degs(small_run(design.front(), folder / "out", more));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.err.find(remedy), std::string::npos) << outcome.err;
        EXPECT_FALSE(report_in(folder / "out").contains("sampling"));
    }
}

TEST(SmallRunSampledOnce, IsExactWhereMemoryIsContended) {
    for (const auto& [bandwidth, sampled] : {std::pair("409.6", true), std::pair("12.8", false)}) {
        SCOPED_TRACE(bandwidth);
        const Folder folder;
        const Outcome outcome = degs(small_run(
            "gscore-64", folder / "out",
            {"--within", "5%", "--set", std::string("memory.bandwidth_gb_per_s=") + bandwidth}));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err.find("of the memory's peak") == std::string::npos, sampled)
            << outcome.err;
        const json report = report_in(folder / "out");
        EXPECT_EQ(report.contains("sampling"), sampled);
        EXPECT_EQ(report["dram"]["utilization"] < 1.0 / 3, sampled) << report["dram"];
    }
}

TEST(SampledRunOnce, TakesGbuWithoutItsReuseCacheOnly) {
    const std::vector<std::string> sampled{"--fidelity", "sampled:40%"};
    const Folder folder;
    const Outcome cached = degs(small_run("gbu-64", folder / "cached", sampled));
    EXPECT_NE(cached.err.find("reuse_cache.bytes=0"), std::string::npos) << cached.err;
    EXPECT_FALSE(report_in(folder / "cached").contains("sampling"));
    const std::string none = "reuse_cache.bytes=0";
    const json exact = sampled_report_of("gbu-64", {"--set", none});
    const json sample = sampled_report_of("gbu-64", {"--set", none, "--fidelity", "sampled:40%"});
    for (const char* path : {"timing.cycles", "dram.bytes_read", "energy.total_nj"}) {
        EXPECT_NEAR(number(sample, path), number(exact, path), 0.03 * number(exact, path)) << path;
    }
}

TEST(SmallRunSampledOnce, TakesGccInSmallViews) {
    const std::vector<std::string> views{"--set", "view_size=32"};
    std::vector<std::string> sampled = views;
    sampled.insert(sampled.end(), {"--fidelity", "sampled:40%"});
    const json exact = sampled_report_of("gcc-64", views);
    const json sample = sampled_report_of("gcc-64", sampled);
    ASSERT_TRUE(sample.contains("sampling"));
    for (const char* path : {"timing.cycles", "slots.useful", "energy.total_nj"}) {
        EXPECT_NEAR(number(sample, path), number(exact, path), 0.03 * number(exact, path)) << path;
    }
}

class TooFewTiles : public ::testing::TestWithParam<const char*> {};

TEST_P(TooFewTiles, AreAllSimulated) {
    const Folder folder;
    const Outcome outcome =
        degs({"run", config("degs-64"), "--scene", "synthetic:single", "--width", GetParam(),
              "--within", "1%", "--no-reference", "--out", folder / "out"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("needs at least"), std::string::npos) << outcome.err;
    EXPECT_FALSE(report_in(folder / "out").contains("sampling"));
}

INSTANTIATE_TEST_SUITE_P(Widths, TooFewTiles, ::testing::Values("1", "20", "200"));

TEST(SampledRunOnce, GivesComparisonsAndStudiesTheirIntervals) {
    const Folder folder;
    const Outcome compared =
        degs({"compare", config("gscore-64"), config("degs-64"), "--scene",
              "synthetic:object,gaussians=6000", "--camera", "2", "--width", "768", "--within",
              "5%", "--seed", "7", kFed[0], kFed[1], "--out", folder / "compare"});
    EXPECT_EQ(compared.code, 0) << compared.err;
    EXPECT_NE(compared.out.find("±"), std::string::npos) << compared.out;
    const json comparison = json::parse(read_file(folder / "compare/compare.json"));
    const json& run = comparison["runs"][0];
    const json single = sampled_report_of("gscore-64", {"--within", "5%", "--seed", "7"});
    EXPECT_EQ(run["cycles"], single["timing"]["cycles"]);
    EXPECT_EQ(run["interval"]["cycles"], single["sampling"]["intervals"]["timing"]["cycles"]);
    EXPECT_LT(run["interval"]["sampled"], 0.7);
    EXPECT_NE(read_file(folder / "compare/compare.csv").find("interval.cycles_low"),
              std::string::npos);

    std::ofstream(folder / "s.yaml")
        << "study: s\ndesigns:\n  - include: " << config("gscore-64")
        << "\n    name: gscore-64\n    memory: {bandwidth_gb_per_s: 409.6}\n"
        << "axes:\n  memory.latency_ns: [100, 150]\n"
        << "scenes: synthetic:object,gaussians=6000\ncameras: [2]\nwidth: 768\n";
    const std::vector<std::string> sweep{"sweep", folder / "s.yaml", "--no-reference", "--out",
                                         folder / "sweep"};
    std::vector<std::string> sampled = sweep;
    sampled.insert(sampled.end(), {"--within", "5%", "--seed", "7"});
    EXPECT_EQ(degs(sampled).code, 0);
    const json results = json::parse(read_file(folder / "sweep/results.json"));
    ASSERT_EQ(results["runs"].size(), 2U);
    EXPECT_EQ(results["runs"][0]["interval"], run["interval"]);
    // Points of a sample are not those of exact runs.
    EXPECT_EQ(degs(sweep).code, 0);
    const json exact = json::parse(read_file(folder / "sweep/results.json"));
    ASSERT_EQ(exact["runs"].size(), 2U);
    EXPECT_FALSE(exact["runs"][0].contains("interval"));
    EXPECT_NE(exact["runs"][0]["cycles"], results["runs"][0]["cycles"]);
}

TEST(HostileSampling, AbsurdRequestsAreRefused) {
    const Folder folder;
    for (const char* within : {"0%", "-1%", "60%", "1", "", "%", "nan%", "inf%", "1%%",
                               "useful:", "useful:0%", "nonsense:1%", ":1%", "1%:useful"}) {
        expect_mistake(degs(small_run("degs-64", folder / "out", {"--within", within})),
                       "--within");
    }
    for (const char* fidelity :
         {"sampled", "sampled:", "sampled:0%", "sampled:100%", "sampled:x%", "fast"}) {
        expect_mistake(degs(small_run("degs-64", folder / "out", {"--fidelity", fidelity})),
                       "--fidelity");
    }
    for (const char* command : {"compare", "sweep"}) {
        expect_mistake(degs({command, config("degs-64"), "--scene", "synthetic:single", "--frames",
                             "2", "--within", "1%", "--out", folder / "out"}),
                       "--frames");
    }
    for (const auto& [option, value] :
         {std::pair("--maps", "maps"), std::pair("--trace", "t.json"), std::pair("--frames", "2"),
          std::pair("--fidelity", "strict"), std::pair("--fidelity", "sampled:5%")}) {
        const bool file = std::string(value).find_first_of("mt") == 0;
        expect_mistake(degs(small_run("degs-64", folder / "out",
                                      {"--within", "1%", option, file ? folder / value : value})),
                       option);
    }
}

TEST(Amounts, SurviveTheWayThereAndBack) {
    AcceleratorResult run;
    run.cycles = run.memory_window = 1000;
    run.hazards = 3;
    StageUse stage;
    stage.units = 2;
    stage.busy_cycles = 500;
    stage.busy = 0.25;
    stage.counters.count("rows", std::uint64_t{70}, "rows", "Rows.");
    stage.counters.count("queue_high_water", std::uint64_t{9}, "cells", "Most cells.");
    run.stages.push_back(stage);
    run.streams.push_back({"splats", "", false, 640, 64, 11, {}});
    run.memory_utilization = 0.5;
    std::vector<double> amounts = sim::amounts_of(run);
    const AcceleratorResult same = sim::with_amounts(run, amounts);
    EXPECT_EQ(sim::amounts_of(same), amounts);
    for (double& amount : amounts) {
        amount *= 2;
    }
    run.cycles = run.memory_window = 4000;
    const AcceleratorResult twice = sim::with_amounts(run, amounts);
    EXPECT_DOUBLE_EQ(twice.stages[0].busy, 1000.0 / (2 * 4000));
    EXPECT_DOUBLE_EQ(twice.memory_utilization, 1000.0 / 4000);
    EXPECT_EQ(twice.streams[0].bytes_read, 1280U);
    std::vector<std::uint64_t> counters;
    for (const Counters::Counter& counter : twice.stages[0].counters) {
        counters.push_back(counter.value);
    }
    EXPECT_EQ(counters, (std::vector<std::uint64_t>{140, 9})) << "a peak does not add up";
    amounts.pop_back();
    EXPECT_THROW(sim::with_amounts(run, amounts), std::logic_error);
}

} // namespace
} // namespace degs::sim_test
