// SPDX-License-Identifier: Apache-2.0
// Thresholds of bandwidth, of latencies that are made up and whose thresholds are known.
#include "sim/search/bandwidth_search.hpp"

#include <cmath>
#include <functional>

#include "sim/search/design_study.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;

using Latency = std::function<double(double gb_per_s)>;

/// Memory and the rest of a frame overlap by a power mean: at 10 % more the gain falls to 1 % where
/// the memory has 0.1 / (1 - 0.1) of the rest, to the power of the mean.
Latency frame(double gigabytes, double rest_ms) {
    return [=](double gb_per_s) {
        return std::cbrt(std::pow(1e3 * gigabytes / gb_per_s, 3) + std::pow(rest_ms, 3));
    };
}

struct Found {
    BandwidthThreshold threshold;
    int simulated_steps = 0;
};

Found find_threshold(const std::string& design, const std::vector<std::string>& sets,
                     const Latency& estimated, const Latency& simulated) {
    const Folder folder;
    std::ofstream(folder / "s.yaml") << "designs:\n  - include: " << config(design)
                                     << "\n    name: a\nscenes: synthetic:object,gaussians=10\n"
                                        "width: 16\n";
    Study study = study_of_designs(read_study(folder / "s.yaml"), "s.yaml", "a test");
    study.overrides = sets;
    const BandwidthSteps steps = bandwidth_steps(first_design(study));
    study.axes = {steps.axis};
    StudyPlan plan = plan_views(study);
    DesignSpace space(study, plan);
    space.add_baseline();
    BandwidthSearch search(space, plan, steps);
    Found found;
    while (const std::optional<Step> step = search.next()) {
        const bool estimates = step->runs == PartRuns::Estimates;
        found.simulated_steps += estimates ? 0 : 1;
        StepResults results;
        for (const std::size_t variant : step->variants) {
            const double value = std::stod(plan.variants[variant].values.front());
            std::size_t position = 0;
            while (std::stod(steps.axis.positions[position].front().text) != value) {
                ++position;
            }
            const double rate = steps.gb_per_s[position];
            Candidate candidate{variant, {}};
            candidate.verdict.goals = {estimates ? estimated(rate) : simulated(rate)};
            results.candidates.push_back(candidate);
        }
        search.take(results);
        if (found.simulated_steps > 30) {
            ADD_FAILURE() << "it does not end";
            break;
        }
    }
    found.threshold = search.threshold();
    return found;
}

/// Where the slope of the latency in logarithms is that of 1 % for 10 %, by bisection.
double threshold_of(const Latency& latency) {
    const double wanted = std::log(1.01) / std::log(1.1);
    double low = 1e-3, high = 1e6;
    for (int i = 0; i < 200; ++i) {
        const double middle = std::sqrt(low * high), h = 1e-4;
        const double slope =
            std::log(latency(middle * (1 - h)) / latency(middle * (1 + h))) / (2 * h);
        (slope > wanted ? low : high) = middle;
    }
    return low;
}

TEST(BandwidthSearch, FindsTheThresholdWhereTheEstimatesAreRight) {
    for (const double gigabytes : {0.02, 0.3, 2.0}) {
        const Latency latency = frame(gigabytes, 3);
        const Found found = find_threshold("degs-64", {}, latency, latency);
        ASSERT_TRUE(found.threshold.gb_per_s) << found.threshold.none;
        const double exact = threshold_of(latency);
        EXPECT_NEAR(*found.threshold.gb_per_s / exact, 1, 0.02);
        EXPECT_LE(found.threshold.low, 1.01 * exact);
        EXPECT_GE(found.threshold.high, 0.99 * exact);
        EXPECT_NEAR(found.threshold.high / found.threshold.low, 1.1, 0.01);
        EXPECT_NEAR(*found.threshold.estimated / exact, 1, 0.06);
        EXPECT_LE(found.threshold.simulated, 4U);
    }
}

TEST(BandwidthSearch, GoesOnWhereTheEstimatesAreWrong) {
    for (const double off : {0.3, 0.7, 1.5, 4.0}) {
        const Latency latency = frame(0.3, 3);
        const Found found = find_threshold("degs-64", {}, frame(0.3 * off, 3), latency);
        ASSERT_TRUE(found.threshold.gb_per_s) << found.threshold.none;
        EXPECT_NEAR(*found.threshold.gb_per_s / threshold_of(latency), 1, 0.02) << off;
        EXPECT_LE(found.threshold.simulated, 12U) << off;
    }
}

TEST(BandwidthSearch, VariesTheDataRateOfLpddr5) {
    const Latency latency = frame(0.5, 3);
    const Found found = find_threshold("degs-64", {"memory.model=lpddr5"}, latency, latency);
    ASSERT_TRUE(found.threshold.gb_per_s) << found.threshold.none;
    EXPECT_NEAR(*found.threshold.gb_per_s / threshold_of(latency), 1, 0.02);
}

TEST(BandwidthSearch, SaysThatThereIsNone) {
    const Latency never = [](double) { return 3.0; };
    EXPECT_NE(find_threshold("degs-64", {}, never, never).threshold.none.find("Already at"),
              std::string::npos);
    const Latency always = [](double gb_per_s) { return 1e3 / gb_per_s; };
    const Found found = find_threshold("degs-64", {}, always, always);
    EXPECT_NE(found.threshold.none.find("Even at"), std::string::npos);
    EXPECT_FALSE(found.threshold.gb_per_s);
}

// Between the bounds of the interval, 10 % more begin to gain less than 1 %.
TEST(BandwidthCommand, AgreesWithRuns) {
    const Folder folder;
    const Outcome outcome =
        degs({"bandwidth", config("gscore-64"), "--scene", "synthetic:object,gaussians=600",
              "--camera", "2", "--width", "160", "--jobs", "2", "--out", folder / "out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto found = nlohmann::json::parse(read_file(folder / "out/bandwidth.json"));
    const auto& threshold = found["thresholds"][0];
    ASSERT_TRUE(threshold["gb_per_s"].is_number()) << threshold;
    const double low = threshold["low_gb_per_s"], high = threshold["high_gb_per_s"];
    EXPECT_LE(low, threshold["gb_per_s"].get<double>());
    EXPECT_GE(high, threshold["gb_per_s"].get<double>());
    const auto cycles = [&](double rate) {
        expect_success(
            degs({"run", config("gscore-64"), "--scene", "synthetic:object,gaussians=600",
                  "--camera", "2", "--width", "160", "--no-reference", "--set",
                  "memory.bandwidth_gb_per_s=" + std::to_string(rate), "--out", folder / "run"}));
        return report_in(folder / "run")["timing"]["cycles"].get<double>();
    };
    const double half = std::sqrt(1.1); // gains belong to the middle of a step
    EXPECT_GE(cycles(low / half) / cycles(low * half), 1.0095);
    EXPECT_LE(cycles(high / half) / cycles(high * half), 1.0105);
    EXPECT_TRUE(fs::exists(folder / "out/bandwidth.svg"));
    expect_mistake(degs({"bandwidth", config("studies/buffers")}), "has axes");
}

} // namespace
} // namespace degs::sim_test
