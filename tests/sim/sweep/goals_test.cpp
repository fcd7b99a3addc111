// SPDX-License-Identifier: Apache-2.0
// Goals and limits: expressions, fronts in many goals, and what a search and a sweep make of them.
#include <cmath>
#include <random>

#include "degs/error.hpp"
#include "sim/goals/judgement.hpp"
#include "tests/sim/process/child.hpp"
#include "tests/sim/search/random_goals.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;
using Positions = std::vector<std::size_t>;

Measures some_measures() {
    Measures measures;
    measures[Measure::LatencyMs] = 2;
    measures[Measure::AreaMm2] = 3;
    measures[Measure::NjPerFrame] = 50;
    measures[Measure::Fps] = 500;
    return measures;
}

double number_from(const std::string& text) {
    return Expression::parse(text, "here").value(some_measures()).value_or(-1e9);
}

TEST(Expression, IsArithmeticOverMeasures) {
    EXPECT_EQ(number_from("energy.nj_per_frame*latency_ms"), 100);
    EXPECT_EQ(number_from("1+2*3"), 7);
    EXPECT_EQ(number_from("(1 + 2) * 3"), 9);
    EXPECT_EQ(number_from("8/4/2"), 1);
    EXPECT_EQ(number_from("8-4-2"), 2);
    EXPECT_EQ(number_from("-latency_ms - -1.5e1"), 13);
    EXPECT_EQ(number_from("area_mm2/(latency_ms-2)"), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(Expression::parse("image.ssim+1", "here").value(some_measures()));
    EXPECT_FALSE(Expression::parse("0/(latency_ms-2)", "here").value(some_measures()));
}

void expect_refused(const std::function<void()>& act, const std::string& words) {
    try {
        act();
        ADD_FAILURE() << "nothing is wrong about " << words;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(HostileExpression, EndsInASentence) {
    for (const std::string text :
         {"", "+", "1+", "(latency_ms", "latency_ms)", "2 latency_ms", "3*/4", "latency_ms;", "..",
          "foo(fps)", "1e999999", "fps fps"}) {
        expect_refused([&] { Expression::parse(text, "--goals"); }, "--goals says ");
    }
    expect_refused([] { Expression::parse(std::string(100000, '('), "--goals"); }, "too deeply");
    expect_refused([] { Expression::parse(std::string(100000, '-'), "--goals"); }, "too deeply");
    expect_refused([] { Expression::parse("1/latency", "--goals"); }, "did you mean 'latency_ms'");
}

TEST(Goals, HaveTheDirectionOfTheirMeasures) {
    const auto better = [](const std::string& text) {
        return parse_goals(text, "--goals")[0].better;
    };
    EXPECT_EQ(better("energy.nj_per_frame*latency_ms"), Direction::Minimise);
    EXPECT_EQ(better("fps/area_mm2"), Direction::Maximise);
    EXPECT_EQ(better("1/fps"), Direction::Minimise);
    EXPECT_EQ(better("10-latency_ms"), Direction::Maximise);
    EXPECT_EQ(better("-2*fps+1"), Direction::Minimise);
    EXPECT_EQ(better("max:dram.utilization"), Direction::Maximise);
    EXPECT_EQ(better("min:fps"), Direction::Minimise);
    EXPECT_EQ(better("worst(fps)"), Direction::Maximise);
    const auto goals = parse_goals("fps, max: image.psnr_db ,worst( 2 * latency_ms )", "--goals");
    ASSERT_EQ(goals.size(), 3U);
    EXPECT_EQ(goals[1].name, "image.psnr_db");
    EXPECT_EQ(goals[2].name, "worst(2*latency_ms)");
    EXPECT_EQ(goals[2].fold, Fold::Worst);
    const auto refuses = [](const std::string& text, const std::string& words) {
        expect_refused([&] { parse_goals(text, "--goals"); }, words);
    };
    refuses("fps*latency_ms", "write 'min:' or 'max:' in front");
    refuses("dram.utilization", "neither small nor large");
    refuses("max:host.sim_s", "neither small nor large");
    refuses("fps,latency_ms,fps", "twice");
    refuses("worst(fps)*2", "can only surround all of a goal");
    refuses("baseline*fps", "right side of a limit");
    refuses("fps,,area_mm2", "--goals says");
    refuses("cycles,latency_ms,fps,area_mm2,image.ssim,image.psnr_db,dram.bytes_read", "at most 6");
}

TEST(Limits, AreBoundsOnMeasures) {
    const auto limits = parse_limits("area_mm2 <= 2.5, worst(fps)>1.02*baseline, "
                                     "latency_ms<baseline(gpu, small)",
                                     "--limits");
    ASSERT_EQ(limits.size(), 3U);
    EXPECT_EQ(limits[0].name, "area_mm2<=2.5");
    EXPECT_TRUE(limits[0].at_most && limits[0].or_equal);
    EXPECT_FALSE(limits[1].at_most || limits[1].or_equal);
    EXPECT_EQ(designs_in({{}, limits}), std::vector<std::string>{"gpu, small"});
    for (const std::string text : {"area_mm2", "<=2", "area_mm2=2", "area_mm2<=", "area_mm2<=fps",
                                   "area_mm2==2", "fps>=baseline(x"}) {
        expect_refused([&] { parse_limits(text, "--limits"); }, "--limits says");
    }
}

/// Two designs on two views: latencies 1 and 4 ms of the first, 2 and 3 ms of the second.
Comparison two_designs() {
    Comparison comparison;
    comparison.configs = {{"base", "", {}, {}, {}}, {"other", "", {}, {}, {}}};
    comparison.views.resize(2);
    for (const auto& [config, view, ms] : {std::tuple(0, 0, 1.0), std::tuple(1, 0, 2.0),
                                           std::tuple(0, 1, 4.0), std::tuple(1, 1, 3.0)}) {
        ComparisonRow row;
        row.config = config;
        row.view = view;
        row.measures[Measure::LatencyMs] = ms;
        row.measures[Measure::AreaMm2] = config == 0 ? 2 : 1;
        comparison.rows.push_back(row);
    }
    return comparison;
}

std::vector<DesignVerdict> judged(const std::string& goals, const std::string& limits) {
    return judge(two_designs(), 2,
                 {parse_goals(goals, "--goals"),
                  limits.empty() ? std::vector<Limit>() : parse_limits(limits, "--limits")});
}

TEST(Judgement, TakesTheMeanOrTheWorstOfTheViews) {
    const auto verdicts = judged("latency_ms,worst(latency_ms),area_mm2", "");
    EXPECT_DOUBLE_EQ(*verdicts[0].goals[0], 2);
    EXPECT_DOUBLE_EQ(*verdicts[1].goals[0], std::sqrt(6.0));
    EXPECT_EQ(*verdicts[0].goals[1], 4);
    EXPECT_EQ(*verdicts[1].goals[1], 3);
    EXPECT_EQ(*verdicts[1].goals[2], 1);
    EXPECT_TRUE(verdicts[0].on_front && verdicts[1].on_front);
    EXPECT_FALSE(judged("worst(latency_ms),area_mm2", "")[0].on_front);
    EXPECT_EQ(*judged("max:worst(latency_ms)", "")[0].goals[0], 1); // of what shall be large
    EXPECT_EQ(*judged("max:worst(latency_ms)", "")[1].goals[0], 2);
    EXPECT_EQ(*judged("max:latency_ms-1", "")[0].goals[0], 0); // the mean of 0 and 3
    EXPECT_EQ(*judged("max:3-latency_ms", "")[1].goals[0], 0); // of 1 and 0
}

TEST(Judgement, LooksAtLimits) {
    const auto verdicts = judged("latency_ms,area_mm2", "latency_ms<=1.2*baseline,area_mm2<=2");
    EXPECT_EQ(within_words(verdicts[0]), "yes");
    EXPECT_EQ(within_words(verdicts[1]), "latency_ms<=1.2*baseline");
    EXPECT_NEAR(verdicts[1].excess, std::sqrt(6.0) / 2.4 - 1, 1e-12);
    EXPECT_TRUE(verdicts[0].on_front);
    EXPECT_FALSE(verdicts[1].on_front);
    EXPECT_EQ(within_words(judged("area_mm2", "worst(latency_ms)<=baseline(other)")[0]),
              "worst(latency_ms)<=baseline(other)");
    EXPECT_EQ(within_words(judged("area_mm2", "area_mm2<=2,area_mm2<2,area_mm2>=3")[0]),
              "area_mm2<2; area_mm2>=3");
    EXPECT_EQ(within_words(judged("area_mm2", "image.ssim>=0.9")[0]), "");
    EXPECT_EQ(within_words(judge(two_designs(), 3, {})[0]), "");
}

/// Nobody beats a design that is as good as one of the front, whatever stands first.
TEST(Judgement, EqualDesignsAreOnTheFrontTogether) {
    Comparison comparison = two_designs();
    comparison.configs.push_back({"twin", "", {}, {}, {}});
    comparison.configs.push_back({"worse", "", {}, {}, {}});
    for (const auto& [config, of, more] : {std::tuple(2U, 0U, 0.0), std::tuple(3U, 0U, 0.5)}) {
        for (std::size_t r = 0; r < 4; ++r) {
            ComparisonRow row = comparison.rows[r];
            if (row.config == of) {
                row.config = config;
                row.measures[Measure::AreaMm2] = 2 + more;
                comparison.rows.push_back(row);
            }
        }
    }
    const auto verdicts = judge(comparison, 2, {parse_goals("latency_ms,area_mm2", "--goals"), {}});
    EXPECT_TRUE(verdicts[0].on_front);
    EXPECT_TRUE(verdicts[1].on_front);
    EXPECT_TRUE(verdicts[2].on_front);
    EXPECT_FALSE(verdicts[3].on_front);
}

/// Whether another is at least as good in all goals, and the better one or the earlier.
bool is_beaten(const std::vector<Goals>& goals, std::size_t own) {
    for (std::size_t other = 0; other < goals.size(); ++other) {
        bool reaches = other != own;
        for (std::size_t g = 0; g < goals[own].size(); ++g) {
            reaches = reaches && goals[other][g] <= goals[own][g];
        }
        if (reaches && (goals[other] != goals[own] || other < own)) {
            return true;
        }
    }
    return false;
}

TEST(ParetoFront, HasWhomNobodyBeatsInAnyNumberOfGoals) {
    std::mt19937 random(5);
    for (std::size_t round = 0; round < 200; ++round) {
        const auto goals = random_goals(random, 40, 1 + round % 6);
        Positions front = pareto_front(goals);
        EXPECT_TRUE(std::is_sorted(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
            return goals[a] < goals[b];
        }));
        std::sort(front.begin(), front.end());
        Positions wanted;
        for (std::size_t d = 0; d < goals.size(); ++d) {
            if (!is_beaten(goals, d)) {
                wanted.push_back(d);
            }
        }
        EXPECT_EQ(front, wanted);
    }
}

/// A study of 12 designs on two views.
std::string small_space(const Folder& folder, const std::string& more = "") {
    const std::string file = folder / "space.yaml";
    std::ofstream(file) << "study: space\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\naxes:\n  span.count: [2, 4, 8, 16]\n"
                           "  array.pes_per_bank: [4, 8, 16]\n"
                           "scenes: synthetic:object,gaussians=300\ncameras: [0, 2]\n"
                           "width: 128\nfidelity: analytic\n"
                        << more;
    return file;
}

std::vector<std::vector<std::string>> cells_of(const std::string& file) {
    std::istringstream lines(read_file(file));
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) {
            rows.back().push_back(cell);
        }
    }
    return rows;
}

TEST(ExploreGoals, FindsTheFrontOfThreeWithinLimits) {
    const Folder folder;
    const std::string goals = "latency_ms, area_mm2, cycles*area_mm2";
    const Outcome found =
        degs({"explore", small_space(folder), "--goals", goals, "--limits",
              "area_mm2<=baseline,worst(latency_ms)<=2*baseline", "--out", folder / "a"});
    ASSERT_EQ(found.code, 0) << found.err;
    EXPECT_NE(found.out.find(" designs are within them"), std::string::npos) << found.out;
    const auto rows = cells_of(folder / "a/front.csv");
    const std::vector<std::string> end{"area_mm2", "cycles*area_mm2", "worst(latency_ms)",
                                       "on_front", "baseline",        "fidelity",
                                       "within"};
    EXPECT_EQ(std::vector<std::string>(rows[0].end() - 7, rows[0].end()), end);
    std::vector<Goals> within;
    std::vector<bool> on_front;
    double base = 0;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        base = rows[r][8] == "1" ? std::stod(rows[r][4]) : base;
    }
    for (std::size_t r = 1; r < rows.size(); ++r) {
        const std::vector<std::string>& row = rows[r];
        EXPECT_EQ(std::stod(row[4]) > base,
                  row[10].find("area_mm2<=baseline") != std::string::npos);
        if (row[10] == "yes") {
            within.push_back({std::stod(row[3]), std::stod(row[4]), std::stod(row[5])});
            on_front.push_back(row[7] == "1");
        } else {
            EXPECT_EQ(row[7], "0");
        }
    }
    ASSERT_GE(within.size(), 2U);
    EXPECT_LT(within.size(), rows.size() - 1);
    for (std::size_t d = 0; d < within.size(); ++d) {
        EXPECT_EQ(on_front[d], !is_beaten(within, d));
    }
    const auto explored = nlohmann::json::parse(read_file(folder / "a/explore.json"));
    EXPECT_EQ(explored["goals"].size(), 3U);
    EXPECT_EQ(explored["limits"][1], "worst(latency_ms)<=2*baseline");
    EXPECT_TRUE(explored["results"]["designs"][0].contains("within"));
    EXPECT_EQ(cells_of(folder / "a/results.csv")[0].back(), "within");
}

TEST(LongExploreGoals, StandInAStudyToo) {
    const Folder folder;
    const std::string file =
        small_space(folder, "goals: [latency_ms, \"max:fps/area_mm2\"]\nlimits: area_mm2<=0.1\n");
    const Outcome none = degs({"explore", file, "--out", folder / "a"});
    ASSERT_EQ(none.code, 0) << none.err;
    EXPECT_NE(none.out.find("no design is within the limits"), std::string::npos) << none.out;
    EXPECT_EQ(cells_of(folder / "a/front.csv")[0][4], "fps/area_mm2");
    ASSERT_EQ(degs({"explore", file, "--goals", "area_mm2", "--limits", "area_mm2>=0.1", "--out",
                    folder / "b"})
                  .code,
              0);
    const auto rows = cells_of(folder / "b/front.csv");
    EXPECT_EQ(rows[1][4], "1"); // the smallest, and no other
    EXPECT_EQ(rows[2][4], "0");
    ASSERT_EQ(degs({"sweep", file, "--out", folder / "c"}).code, 0);
    EXPECT_EQ(cells_of(folder / "c/results.csv")[1].back(), "area_mm2<=0.1");
    const auto swept = nlohmann::json::parse(read_file(folder / "c/results.json"));
    EXPECT_EQ(swept["variants"][0]["within"], "area_mm2<=0.1");
}

TEST(ExploreGoals, RefuseWhatDoesNotExist) {
    const Folder folder;
    const auto refuses = [&folder](const std::string& option, const std::string& text,
                                   const std::string& words) {
        expect_mistake(degs({"explore", small_space(folder), option, text, "--out", folder / "a"}),
                       words);
        EXPECT_FALSE(fs::exists(folder / "a"));
    };
    refuses("--goals", "latency_ms,energy.nj_per_fram*latency_ms,area_mm2",
            "did you mean 'energy.nj_per_frame'?");
    refuses("--limits", "image.psnr_db>=60",
            "Estimates have no image.psnr_db, so it cannot be in a limit");
    refuses("--limits", "fps>=baseline(degs-65)",
            "no point of the study has this name; it may mean 'degs-64'.");
    expect_mistake(
        degs({"explore", small_space(folder, "goals: [fps, latency]\n"), "--out", folder / "a"}),
        "key 'goals'");
}

} // namespace
} // namespace degs::sim_test
