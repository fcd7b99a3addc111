// SPDX-License-Identifier: Apache-2.0
// What bandwidth is worth: memory_bound and limited_by beside what more bandwidth gains, and the
// curves of a study that varies it.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "sim/sweep/bandwidth_curve.hpp"
#include "tests/sim/process/child.hpp"
#include "tests/sim/process/csv_rows.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;

/// Latencies of a design at these bandwidths, GB/s.
struct Curve {
    StudyPlan plan;
    Comparison comparison;

    explicit Curve(const std::vector<std::pair<double, double>>& points) {
        plan.keys = {"memory.bandwidth_gb_per_s", "clock_ghz"};
        comparison.views.resize(1);
        for (const auto& [gb_per_s, latency_ms] : points) {
            StudyVariant variant;
            variant.design = "d";
            variant.values = {"", "1"};
            variant.memory_model = variant.memory_name = "bus";
            ComparisonRow row;
            row.config = plan.variants.size();
            row.measures[Measure::DramPeak] = gb_per_s;
            row.measures[Measure::LatencyMs] = latency_ms;
            plan.variants.push_back(variant);
            comparison.rows.push_back(row);
        }
    }
};

TEST(BandwidthCurves, InterpolateInTheLogarithms) {
    Curve curve({{400, 1}, {1e5, 0.9}, {100, 2}, {200, std::sqrt(2)}}); // in any order
    const auto list = elasticities(curve.plan, curve.comparison);
    ASSERT_EQ(list.size(), 4U);
    EXPECT_FALSE(list[0]);
    EXPECT_FALSE(list[1]);
    EXPECT_FALSE(list[2]);
    EXPECT_NEAR(list[3].value().gain, 100 * (std::sqrt(1.1) - 1), 1e-9);
    EXPECT_FALSE(list[3]->low) << "exact runs";
    const auto curves = bandwidth_curves(curve.plan, curve.comparison);
    ASSERT_EQ(curves.size(), 1U);
    EXPECT_EQ(curves[0].points.size(), 3U);
    EXPECT_EQ(curves[0].unlimited_latency_ms, 0.9);
    EXPECT_FALSE(curves[0].enough_gb_per_s); // 10 % gain 5 % up to the end
}

// The neighbours are 1 % and 2 % wide to both sides, so that four times the bandwidth divide the
// time by 1.98 / 1.02 to 2.02 / 0.98.
TEST(BandwidthCurves, HaveTheIntervalsOfSamples) {
    Curve curve({{100, 2}, {200, 1.4}, {400, 1}});
    const auto set = [&](std::size_t row, double width) {
        ComparisonRow& r = curve.comparison.rows[row];
        r.fidelity = "sampled";
        const double cycles = *r.measures[Measure::LatencyMs] * 1e6;
        r.measures[Measure::Cycles] = cycles;
        r.cycles_low = cycles * (1 - width);
        r.cycles_high = cycles * (1 + width);
    };
    set(0, 0.01);
    set(2, 0.02);
    const auto list = elasticities(curve.plan, curve.comparison);
    const auto gain = [](double saved) {
        return 100 * (std::pow(saved, std::log(1.1) / std::log(4)) - 1);
    };
    EXPECT_NEAR(list[1].value().gain, gain(2), 1e-9);
    EXPECT_NEAR(list[1]->low.value(), gain(1.98 / 1.02), 1e-9);
    EXPECT_NEAR(list[1]->high.value(), gain(2.02 / 0.98), 1e-9);
}

TEST(BandwidthCurves, EndWhereTenPercentGainLessThanOne) {
    // Half of the time is the memory's at 100 GB/s: t = 1 + 100 / b.
    std::vector<std::pair<double, double>> points;
    for (double b = 12.5; b <= 3200; b *= std::sqrt(std::sqrt(2))) {
        points.emplace_back(b, 1 + 100 / b);
    }
    const Curve curve(points);
    const auto curves = bandwidth_curves(curve.plan, curve.comparison);
    // The slope of the logarithms is s = -100 / (b + 100), and 1.1^-s = 1.01 at b = 858.
    EXPECT_NEAR(curves.at(0).enough_gb_per_s.value(), 858, 10);
    const std::string picture = bandwidth_picture(curve.plan, curve.comparison);
    EXPECT_NE(picture.find("GB/s</text>"), std::string::npos);
}

TEST(BandwidthCurves, AreOfStudiesThatVaryTheMemory) {
    Curve curve({{100, 2}, {200, 1}});
    EXPECT_FALSE(bandwidth_picture(curve.plan, curve.comparison).empty());
    curve.plan.variants[1].values[1] = "2"; // another clock is another line
    EXPECT_TRUE(bandwidth_curves(curve.plan, curve.comparison).empty());
    EXPECT_TRUE(elasticities(curve.plan, curve.comparison).empty());
    EXPECT_TRUE(bandwidth_picture(curve.plan, curve.comparison).empty());
    curve.plan.variants[1].values[1] = "1";
    curve.plan.keys = {"packing.bytes", "clock_ghz"};
    EXPECT_TRUE(bandwidth_curves(curve.plan, curve.comparison).empty());
}

/// The results of degs-64, whose memory is a bus, with these axes.
struct MemoryStudy {
    Folder folder;
    std::vector<CsvRow> rows;
    std::string picture;

    explicit MemoryStudy(const std::string& axes) {
        std::ofstream(folder / "study.yaml")
            << "study: memories\ndesigns:\n  - {include: " << config("degs-64")
            << ", name: d}\nscenes: \"synthetic:object,gaussians=2000\"\ncameras: 1\nwidth: 160\n"
               "fidelity: analytic\naxes:\n"
            << axes;
        const Outcome outcome = degs({"sweep", folder / "study.yaml", "--out", folder / "o"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        rows = rows_by_heading(read_file(folder / "o/results.csv"));
        picture = read_file(folder / "o/bandwidth.svg");
    }

    /// Every elasticity from the neighbours among the rows that have the same text in `same`.
    void expect_elasticities(const std::vector<std::string>& same, std::size_t known) const {
        std::map<std::vector<std::string>, std::map<double, const CsvRow*>> lines;
        for (const CsvRow& row : rows) {
            std::vector<std::string> line;
            for (const std::string& key : same) {
                line.push_back(row.at(key));
            }
            lines[line][std::stod(row.at("dram.peak_gb_per_s"))] = &row;
        }
        std::size_t found = 0;
        for (const auto& [key, line] : lines) {
            for (auto at = line.begin(); at != line.end(); ++at) {
                SCOPED_TRACE(at->second->at("point"));
                if (at == line.begin() || std::next(at) == line.end()) {
                    EXPECT_EQ(at->second->at("bandwidth_elasticity"), "");
                    continue;
                }
                const auto before = std::prev(at), after = std::next(at);
                const double gain = std::log(std::stod(before->second->at("latency_ms")) /
                                             std::stod(after->second->at("latency_ms"))) /
                                    std::log(after->first / before->first);
                EXPECT_NEAR(std::stod(at->second->at("bandwidth_elasticity")),
                            100 * (std::exp(gain * std::log(1.1)) - 1), 1e-6);
                ++found;
            }
        }
        EXPECT_EQ(found, known);
    }
};

std::string memory_file(const std::string& name) {
    return config("memory/" + name);
}

TEST(BandwidthCurves, NeverTakeAPointOfAnotherModelOfMemory) {
    // The design's own point is a bus of the bandwidth of the last file.
    const MemoryStudy study("  memory.model: [lpddr5]\n  memory.lpddr5.include: [" +
                            memory_file("lpddr5-3200x128") + ", " + memory_file("lpddr5-6400x128") +
                            ", " + memory_file("lpddr5-6400x256") + "]\n");
    ASSERT_EQ(study.rows.size(), 4U);
    study.expect_elasticities({"memory.model"}, 1);
    EXPECT_NE(study.picture.find("of memory: lpddr5 ("), std::string::npos);
    EXPECT_EQ(study.picture.find("Dashed across"), std::string::npos);
}

TEST(BandwidthCurves, NeverTakeAPointOfAnotherLatencyOfMemory) {
    const MemoryStudy study("  memory.latency_ns: [100, 2000]\n"
                            "  memory.bandwidth_gb_per_s: [12.8, 25.6, 51.2, 204.8]\n");
    ASSERT_EQ(study.rows.size(), 8U);
    study.expect_elasticities({"memory.latency_ns"}, 4);
    EXPECT_NE(study.picture.find("of memory: bus ("), std::string::npos);
    EXPECT_NE(study.picture.find("memory.latency_ns=2000"), std::string::npos);
}

TEST(BandwidthCurves, NeverTakeAPointOfAnotherFileOfMemory) {
    const MemoryStudy study("  memory.model: [lpddr5]\n  memory.lpddr5.include: [" +
                            memory_file("lpddr5-3200x128") + ", " + memory_file("lpddr5-6400x128") +
                            "]\n  memory.lpddr5.channels: [1, 2, 4]\n");
    ASSERT_EQ(study.rows.size(), 7U);
    study.expect_elasticities({"memory.model", "memory.lpddr5.include"}, 2);
    EXPECT_NE(study.picture.find("lpddr5-3200x128: d "), std::string::npos);
    EXPECT_NE(study.picture.find("lpddr5-6400x128: d "), std::string::npos);
}

TEST(BandwidthCurves, OfTwoLatenciesAtOneBandwidthAreNone) {
    const Curve curve({{100, 2}, {200, 1.5}, {200, 1.2}, {400, 1}});
    EXPECT_TRUE(bandwidth_curves(curve.plan, curve.comparison).empty());
}

TEST(BandwidthCurves, ExplainOnlyTheDashedLinesThatTheyHave) {
    const Curve limited({{100, 2}, {200, 1.5}, {400, 1.2}});
    EXPECT_EQ(bandwidth_picture(limited.plan, limited.comparison).find("Dashed"),
              std::string::npos);
    const Curve across({{100, 2}, {200, 1.5}, {400, 1.2}, {1e5, 1}});
    const std::string picture = bandwidth_picture(across.plan, across.comparison);
    EXPECT_NE(picture.find("Dashed across"), std::string::npos);
    EXPECT_EQ(picture.find("Dashed upright"), std::string::npos);
}

/// A point of a study, beside the one with twice its bandwidth.
struct Doubled {
    double bound, gain;
    std::string limit;
};

std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<double> ranks;
    for (const double value : values) { // equal values share their mean rank
        const auto less = std::count_if(values.begin(), values.end(),
                                        [value](double other) { return other < value; });
        const auto equal = std::count(values.begin(), values.end(), value);
        ranks.push_back(static_cast<double>(less) + (static_cast<double>(equal) - 1) / 2);
    }
    return ranks;
}

double spearman(const std::vector<Doubled>& points) {
    std::vector<double> bounds, gains;
    for (const Doubled& point : points) {
        bounds.push_back(point.bound);
        gains.push_back(point.gain);
    }
    const std::vector<double> a = ranks_of(bounds), b = ranks_of(gains);
    const double mean = (static_cast<double>(points.size()) - 1) / 2;
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        ab += (a[i] - mean) * (b[i] - mean);
        aa += (a[i] - mean) * (a[i] - mean);
        bb += (b[i] - mean) * (b[i] - mean);
    }
    return ab / std::sqrt(aa * bb);
}

/// Runs a study whose axis doubles the bandwidth from value to value; by design and view.
std::map<std::string, std::vector<Doubled>> doubled(const std::string& study) {
    const Folder folder;
    std::ofstream(folder / "study.yaml") << study;
    const Outcome outcome =
        degs({"sweep", folder / "study.yaml", "--jobs", "2", "--out", folder / "o"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json results = nlohmann::json::parse(read_file(folder / "o/results.json"));
    std::map<std::string, std::map<double, nlohmann::json>> runs;
    for (const nlohmann::json& run : results["runs"]) {
        const auto& variant = results["variants"][run["variant"].get<std::size_t>()];
        const std::string line = variant["design"].get<std::string>() + run["view"].dump();
        runs[line][run["dram"]["peak_gb_per_s"].get<double>()] = run;
    }
    std::map<std::string, std::vector<Doubled>> all;
    for (const auto& [line, points] : runs) {
        for (auto run = points.begin(); std::next(run) != points.end(); ++run) {
            EXPECT_NEAR(std::next(run)->first / run->first, 2, 1e-9);
            all[line].push_back({run->second["memory_bound"].get<double>(),
                                 run->second["cycles"].get<double>() /
                                         std::next(run)->second["cycles"].get<double>() -
                                     1,
                                 run->second["limited_by"].get<std::string>()});
        }
    }
    EXPECT_NE(read_file(folder / "o/index.html").find("bandwidth of memory, GB/s"),
              std::string::npos);
    EXPECT_NE(read_file(folder / "o/results.csv").find(",bandwidth_elasticity,"),
              std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "o/bandwidth.svg"));
    return all;
}

/// To halve all of the time that memory takes from a frame that it just limits gains a third.
void expect_ranked(const std::map<std::string, std::vector<Doubled>>& lines) {
    int limited = 0, others = 0;
    for (const auto& [line, points] : lines) {
        SCOPED_TRACE(line);
        EXPECT_GE(spearman(points), 0.9);
        for (const Doubled& point : points) {
            SCOPED_TRACE(std::to_string(point.bound) + " " + std::to_string(point.gain));
            const bool is_memory = point.limit == "memory";
            EXPECT_TRUE(is_memory || point.bound <= 0.5);
            EXPECT_TRUE(is_memory ? point.gain >= 0.20 : point.gain <= 0.35);
            ++(is_memory ? limited : others);
        }
    }
    EXPECT_GE(limited, static_cast<int>(lines.size()));
    EXPECT_GE(others, static_cast<int>(lines.size()));
}

std::string designs(const std::vector<std::string>& names, const std::string& more) {
    std::string text = "study: limits\ndesigns:\n";
    for (const std::string& name : names) {
        text += "  - include: " + config(name) + "\n    name: " + name + "\n" + more;
    }
    return text + "reference: false\nwidth: 320\n";
}

TEST(LimitedBy, MemoryIsWhereBandwidthGains) {
    expect_ranked(doubled(designs({"degs-64", "degs-256", "gscore-64", "gbu-64", "gcc-64"},
                                  "    pipeline: {tiles: exact}\n") +
                          "scenes: [\"synthetic:object,gaussians=5000\"]\n"
                          "cameras: [1]\naxes:\n  memory.bandwidth_gb_per_s: 3.2..819.2 x2\n"));
}

TEST(LimitedBy, MemoryIsWhereChannelsGain) {
    expect_ranked(
        doubled(designs({"degs-64", "gscore-64"}, "    memory: {model: lpddr5, lpddr5: {include: " +
                                                      config("memory/lpddr5-3200x128") + "}}\n") +
                "scenes: [\"synthetic:outdoor,gaussians=5000\"]\ncameras: [1]\n"
                "axes:\n  memory.lpddr5.channels: 1..32 x2\n"));
}

} // namespace
} // namespace degs::sim_test
