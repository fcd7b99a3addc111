// SPDX-License-Identifier: Apache-2.0
// --fidelity analytic in the commands that run several designs: the numbers of degs run, nothing
// that only a simulation has, and never a mixture of both.
#include <cmath>
#include <map>
#include <sys/resource.h>

#include "sim/search/evolution.hpp"
#include "sim/search/rank_correlation.hpp"
#include "sim/search/search.hpp"
#include "tests/sim/process/child.hpp"
#include "tests/sim/process/csv_rows.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

const std::string kEstimatedScene = "synthetic:object,gaussians=2000";
/// What simulations have and estimates do not.
const std::vector<std::string> kOnlySimulated{"slots.useful", "dram.bytes_read", "image.psnr_db",
                                              "throughput_fps"};

/// Lines about the progress are allowed.
void expect_no_failure(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

std::vector<std::string> and_more(std::vector<std::string> words,
                                  const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Outcome compare_estimates(const std::string& out, const std::vector<std::string>& more = {}) {
    return degs(
        and_more({"compare", config("degs-64"), config("degs-256"), config("gscore-64"), "--scene",
                  kEstimatedScene, "--width", "320", "--fidelity", "analytic", "--out", out},
                 more));
}

/// A study of `sizes` queues times three numbers of Span Units.
std::string study_in(const Folder& folder, const std::string& more = "", int sizes = 2) {
    const std::string file = folder / "study.yaml";
    std::ofstream text(file);
    text << "study: estimates\ndesigns:\n  - include: " << config("degs-64")
         << "\n    name: degs-64\naxes:\n  span.count: [4, 8, 16]\n  gaussian_buffer.bytes: [72KB";
    for (int size = 1; size < sizes; ++size) {
        text << ", " << 72 + size << "KB";
    }
    text << "]\nscenes: " << kEstimatedScene << "\nwidth: 320\nreference: false\n" << more;
    return file;
}

std::string sweep_out(const Folder& folder, const std::string& study,
                      const std::vector<std::string>& more) {
    const Outcome outcome = degs(and_more({"sweep", study, "--out", folder / "out"}, more));
    expect_no_failure(outcome);
    return outcome.out + outcome.err;
}

/// The fidelities of all rows of the study's results, each once.
std::string fidelities_in(const Folder& folder) {
    std::string words;
    for (const CsvRow& row : rows_by_heading(read_file(folder / "out/results.csv"))) {
        if (words.find(row.at("fidelity")) == std::string::npos) {
            words += row.at("fidelity");
        }
    }
    return words;
}

// An interval lies around its estimate, and is the same wherever it is shown.
TEST(Estimates, CarryTheirIntervals) {
    const Folder folder;
    const Outcome compared = compare_estimates(folder / "out");
    expect_no_failure(compared);
    EXPECT_NE(compared.out.find(" ±"), std::string::npos) << compared.out;
    const json run = json::parse(read_file(folder / "out/compare.json"))["runs"][1];
    const double cycles = run["cycles"], low = run["interval"]["cycles"][0],
                 high = run["interval"]["cycles"][1];
    const CsvRow row = rows_by_heading(read_file(folder / "out/compare.csv"))[1];
    EXPECT_NEAR(std::stod(row.at("interval.cycles_low")), low, 1e-5 * low);
    EXPECT_EQ(row.at("interval.sampled"), "");
    expect_success(degs({"run", config("degs-256"), "--scene", kEstimatedScene, "--width", "320",
                         "--fidelity", "analytic", "--out", folder / "single"}));
    const json single = json::parse(read_file(folder / "single/analytic.json"));
    EXPECT_EQ(single["timing"]["cycles_interval"], run["interval"]["cycles"]);
    EXPECT_EQ(single["timing"]["confidence"], 0.9);
    // docs/analytic.md#intervals
    const double tiles = single["sample"]["carrying_tiles"], share = single["limited_share"];
    const double few = 1 / std::sqrt(tiles);
    const double drawing = 1.645 * single["sample"]["standard_error"].get<double>();
    EXPECT_NEAR(std::log(cycles / low), std::hypot(0.03, drawing) + 0.05 * few + 0.15 * (1 - share),
                1e-6);
    EXPECT_NEAR(std::log(high / cycles), std::hypot(0.065, drawing) + 0.15 * few, 1e-6);
}

TEST(Estimates, AreThoseOfTheSameRun) {
    const Folder folder;
    expect_no_failure(compare_estimates(folder / "out"));
    const json compared = json::parse(read_file(folder / "out/compare.json"));
    ASSERT_EQ(compared["runs"].size(), 3U);
    for (const json& run : compared["runs"]) {
        const std::string name = run["config"];
        expect_no_failure(degs({"run", config(name), "--scene", kEstimatedScene, "--width", "320",
                                "--fidelity", "analytic", "--no-cache", "--out", folder / name}));
        const json alone = json::parse(read_file(folder / (name + "/analytic.json")));
        EXPECT_DOUBLE_EQ(run["cycles"], alone["timing"]["cycles"]) << name;
        EXPECT_EQ(run["fidelity"], "analytic");
    }
}

TEST(Estimates, HaveNothingThatOnlyASimulationHas) {
    const Folder folder;
    expect_no_failure(compare_estimates(folder / "out"));
    const std::vector<CsvRow> rows = rows_by_heading(read_file(folder / "out/compare.csv"));
    ASSERT_EQ(rows.size(), 3U);
    for (const CsvRow& row : rows) {
        EXPECT_EQ(row.at("fidelity"), "analytic");
        for (const std::string& name : kOnlySimulated) {
            EXPECT_EQ(row.at(name), "") << name;
        }
        for (const std::string name :
             {"cycles", "latency_ms", "fps", "area_mm2", "preprocessing_cycles",
              "slots.utilization", "ratio.latency_per_mm2", "energy.nj_per_frame",
              "energy.nj_per_pixel", "energy.average_power_w", "ratio.energy", "host.sim_s"}) {
            EXPECT_GT(std::stod(row.at(name)), 0) << name;
        }
    }
}

TEST(Estimates, HaveThePictureOfBandwidth) {
    const Folder folder;
    const std::string file = folder / "bandwidth.yaml";
    std::ofstream(file) << "designs:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\naxes:\n"
                           "  memory.bandwidth_gb_per_s: 12.8..204.8 x2\nscenes: "
                        << kEstimatedScene << "\nwidth: 320\nfidelity: analytic\n";
    expect_no_failure(degs({"sweep", file, "--out", folder / "out"}));
    const std::string picture = read_file(folder / "out/bandwidth.svg");
    EXPECT_NE(picture.find("of memory: bus (estimated)"), std::string::npos);
    const std::vector<CsvRow> rows = rows_by_heading(read_file(folder / "out/results.csv"));
    ASSERT_EQ(rows.size(), 5U);
    EXPECT_EQ(std::stod(rows[0].at("dram.peak_gb_per_s")), 12.8);
    EXPECT_GT(std::stod(rows[1].at("bandwidth_elasticity")), 0);
    EXPECT_EQ(rows[4].at("bandwidth_elasticity"), ""); // no neighbour
    EXPECT_EQ(rows[4].at("bandwidth_elasticity.low"), "");
    // Four times the bandwidth lie between the neighbours: the slope is that of two doublings, 30 %
    // and a point of latency wide to both sides.
    const double doublings =
        std::log2(std::stod(rows[0].at("latency_ms")) / std::stod(rows[2].at("latency_ms"))) / 2;
    const double width = 0.2 * doublings + 0.01 / (2 * std::log(2));
    const auto gain = [](double slope) { return 100 * (std::exp2(slope * std::log2(1.1)) - 1); };
    EXPECT_NEAR(std::stod(rows[1].at("bandwidth_elasticity")), gain(doublings), 1e-6);
    EXPECT_NEAR(std::stod(rows[1].at("bandwidth_elasticity.low")), gain(doublings - width), 1e-6);
    EXPECT_NEAR(std::stod(rows[1].at("bandwidth_elasticity.high")), gain(doublings + width), 1e-6);
}

TEST(Estimates, AreCalledSoWhereverTheyAreShown) {
    const Folder folder;
    const Outcome outcome = compare_estimates(folder / "out");
    expect_no_failure(outcome);
    EXPECT_NE(outcome.out.find("estimates of the analytic model"), std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("energy"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("starved"), std::string::npos) << outcome.out;
    EXPECT_NE(read_file(folder / "out/index.html").find("(estimates)"), std::string::npos);
    EXPECT_NE(read_file(folder / "out/utilization.svg").find("(estimated)"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "out/slots.svg"));
    const std::string study = study_in(folder, "fidelity: analytic\n");
    const Outcome swept = degs({"sweep", study, "--out", folder / "swept"});
    EXPECT_NE(swept.out.find("estimates of the analytic model"), std::string::npos) << swept.err;
    expect_no_failure(degs({"explore", study, "--out", folder / "found"}));
    EXPECT_NE(read_file(folder / "found/front.svg").find("(estimates)"), std::string::npos);
    EXPECT_EQ(rows_by_heading(read_file(folder / "found/front.csv")).at(0).at("fidelity"),
              "analytic");
}

TEST(Estimates, NeverMixWithSimulations) {
    const Folder folder;
    const std::string study = study_in(folder);
    sweep_out(folder, study, {});
    EXPECT_EQ(fidelities_in(folder), "exact");
    const std::string exact = read_file(folder / "out/results.csv");
    const std::string said = sweep_out(folder, study, {"--fidelity", "analytic"});
    EXPECT_NE(said.find("6 of 6 points done"), std::string::npos) << said;
    EXPECT_EQ(fidelities_in(folder), "analytic");
    const std::string again = sweep_out(folder, study, {"--fidelity", "exact"});
    EXPECT_EQ(again.find("points done"), std::string::npos) << again; // all of them are kept
    EXPECT_EQ(read_file(folder / "out/results.csv"), exact);
}

TEST(Estimates, AreTheSameInParts) {
    const Folder folder;
    const std::string study = study_in(folder, "fidelity: analytic\n");
    sweep_out(folder, study, {});
    const std::string whole = read_file(folder / "out/results.csv");
    for (const std::string part : {"1/2", "2/2"}) {
        expect_no_failure(degs({"sweep", study, "--out", folder / "parts", "--shard", part}));
    }
    expect_no_failure(degs({"sweep", study, "--out", folder / "parts", "--collect"}));
    EXPECT_EQ(read_file(folder / "parts/results.csv"), whole);
    EXPECT_NE(degs({"sweep", study, "--out", folder / "parts", "--collect", "--fidelity", "exact"})
                  .err.find("6 points are missing"),
              std::string::npos);
}

TEST(Estimates, RefuseWhatOnlyASimulationGives) {
    const Folder folder;
    const std::string study = study_in(folder);
    const auto said = [](const std::vector<std::string>& words) {
        const Outcome outcome = degs(and_more(words, {"--fidelity", "analytic"}));
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        return outcome.err;
    };
    const auto has = [](const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    for (const std::string command : {"sweep", "explore", "compare"}) {
        const std::string file = command == "compare" ? config("degs-64") : study;
        const std::vector<std::string> words{command,         file,    "--scene",
                                             kEstimatedScene, "--out", folder / "refused"};
        has(said(and_more(words, {"--frames", "3"})), "--frames");
        has(said(and_more(words, {"--array-only"})), "--array-only");
        has(said(and_more(words, {"--within", "5%"})), "--within");
    }
    const std::string goal = said({"explore", study, "--goals", "area_mm2,dram.bytes_read"});
    has(goal, "Estimates have no dram.bytes_read");
    has(goal, "allowed are cycles, preprocessing_cycles, latency_ms");
    has(goal, "energy.nj_per_frame");
    EXPECT_EQ(goal.find("dram.bytes_written"), std::string::npos) << goal;
    has(degs({"sweep", study, "--fidelity", "sampled:10%"}).err, "must be exact or analytic");
    has(degs({"sweep", study_in(folder, "fidelity: fast\n")}).err, "fidelity");
    EXPECT_FALSE(fs::exists(folder / "refused/reports"));
}

/// Columns of the designs on a scene, in their order.
std::map<std::string, std::vector<double>> columns_of_designs(const std::vector<std::string>& names,
                                                              const std::string& scene,
                                                              const std::string& fidelity) {
    const Folder folder;
    std::vector<std::string> words{"compare"};
    for (const std::string& name : names) {
        words.push_back(config(name));
    }
    expect_no_failure(degs(and_more(words, {"--scene", scene, "--width", "480", "--no-reference",
                                            "--fidelity", fidelity, "--out", folder / "out"})));
    std::map<std::string, std::vector<double>> columns;
    for (const CsvRow& row : rows_by_heading(read_file(folder / "out/compare.csv"))) {
        for (const std::string name : {"cycles", "energy.nj_per_frame"}) {
            columns[name].push_back(std::stod(row.at(name)));
        }
    }
    EXPECT_EQ(columns["cycles"].size(), names.size());
    return columns;
}

TEST(Estimates, RankDesignsAsSimulationsDo) {
    const std::vector<std::string> names{"degs-16",    "degs-64", "degs-256", "gscore-64",
                                         "gscore-256", "gbu-64",  "gbu-256",  "gcc-64"};
    for (const std::string scene :
         {"synthetic:object,gaussians=6000", "synthetic:landscape,gaussians=6000"}) {
        const auto estimated = columns_of_designs(names, scene, "analytic");
        for (const auto& [column, exact] : columns_of_designs(names, scene, "exact")) {
            const auto correlation = sim::rank_correlation(estimated.at(column), exact);
            ASSERT_TRUE(correlation) << scene;
            EXPECT_GE(*correlation, 0.9) << scene << ", " << column;
        }
    }
}

/// Processor time of this process and of its children, s. Other tests run at the same time.
double processor_seconds() {
    double seconds = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        ::getrusage(who, &usage);
        for (const timeval& part : {usage.ru_utime, usage.ru_stime}) {
            seconds += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
        }
    }
    return seconds;
}

/// What a sweep of estimates of 3 x `sizes` points takes.
double seconds_of_sweep(int sizes) {
    const Folder folder;
    const std::string study = study_in(folder, "fidelity: analytic\n", sizes);
    const double begin = processor_seconds();
    sweep_out(folder, study, {"--scene", "synthetic:object,gaussians=200000", "--width", "1920"});
    return processor_seconds() - begin;
}

// Twenty times the points cost less than ten times the time, because the view is projected once.
TEST(Estimates, ShareTheProjectedView) {
    EXPECT_LT(seconds_of_sweep(20), 10 * seconds_of_sweep(1));
}

} // namespace
} // namespace degs::sim_test
