// SPDX-License-Identifier: Apache-2.0
// The laws against every synthesised point of docs/synthesis.csv.
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cost/clock_limits.hpp"
#include "cost/logic_laws.hpp"
#include "stats/statistics_document.hpp"

namespace degs::cost {
namespace {

constexpr double kMostResidual = 0.15;
constexpr double kFlipFlop = 96; // library units

using Point = std::map<std::string, std::string>;

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::istringstream stream(line + ",");
    for (std::string cell; std::getline(stream, cell, ',');) {
        found.push_back(cell);
    }
    return found;
}

/// The rows of a block.
std::vector<Point> points_of(const std::string& block) {
    std::ifstream file(DEGS_CONFIGS "/../docs/synthesis.csv");
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> names = cells(line);
    std::vector<Point> points;
    while (std::getline(file, line)) {
        const std::vector<std::string> row = cells(line);
        if (row.front() == block) {
            Point point;
            for (std::size_t i = 0; i < names.size(); ++i) {
                point[names[i]] = row[i];
            }
            points.push_back(point);
        }
    }
    return points;
}

int number(const Point& point, const char* key) {
    return std::stoi(point.at(key));
}

/// `law` gives area and delay of a point; 0: there is no law. `flops`: the law is without them.
template <class Law>
void expect_points(const char* block, bool flops, const Law& law) {
    const std::vector<Point> points = points_of(block);
    ASSERT_GE(points.size(), 3U) << block;
    for (const Point& point : points) {
        SCOPED_TRACE(block + (" " + point.at("n")) + " " + point.at("k") + " " + point.at("width") +
                     " " + point.at("issue"));
        const auto [area, fo4] = law(point);
        const double measured =
            std::stod(point.at("area")) - (flops ? 0 : kFlipFlop * std::stod(point.at("flops")));
        EXPECT_NEAR(area / measured, 1, kMostResidual);
        if (fo4 != 0) {
            EXPECT_NEAR(fo4 / std::stod(point.at("fo4")), 1, kMostResidual);
        }
    }
}

using AreaAndDelay = std::pair<double, double>;

TEST(LogicLaws, SelectionsAreThoseOfTheSynthesis) {
    const LogicLaws laws;
    expect_points("select_in_turn", false, [&](const Point& p) -> AreaAndDelay {
        const bool serial = number(p, "serial") != 0;
        return {laws.area_in_turn(number(p, "n"), number(p, "k"), serial),
                laws.fo4_in_turn(number(p, "n"), number(p, "k"), serial)};
    });
    expect_points("select_oldest", true, [&](const Point& p) -> AreaAndDelay {
        return {laws.area_oldest(number(p, "n"), number(p, "k")), laws.fo4_oldest(number(p, "k"))};
    });
}

TEST(LogicLaws, AChoiceInSeveralCyclesIsThatOfTheSynthesis) {
    const LogicLaws laws;
    for (const Point& p : points_of("choose_by_dates")) {
        const int n = number(p, "n");
        const int k = number(p, "k");
        const double gates = std::stod(p.at("area")) - kFlipFlop * std::stod(p.at("flops"));
        EXPECT_NEAR(laws.area_pipelined(n, k, 1) / gates, 1, kMostResidual);
    }
    const auto expect_fo4 = [](const char* block, double per_step) {
        const std::vector<Point> points = points_of(block);
        EXPECT_EQ(points.size(), 2U) << block;
        for (const Point& p : points) {
            const double steps = std::log2(number(p, "n") * number(p, "k"));
            EXPECT_NEAR(per_step * steps / std::stod(p.at("fo4")), 1, kMostResidual) << block;
        }
    };
    expect_fo4("choose_by_dates", laws.by_dates_fo4);
    expect_fo4("choose_in_turn", laws.chosen_fo4);
    expect_fo4("group_dates", laws.group_fo4);
    EXPECT_EQ(laws.fo4_pipelined(16, 2, 1),
              5 * (laws.by_dates_fo4 + laws.group_fo4)); // both in one cycle
}

TEST(LogicLaws, StateOfABankIsThatOfTheSynthesis) {
    const LogicLaws laws;
    expect_points("domain_state", true, [&](const Point& p) -> AreaAndDelay {
        return {laws.area_domains(number(p, "n"), number(p, "issue")), 0};
    });
    expect_points("segment_queue", true, [&](const Point& p) -> AreaAndDelay {
        const int depth = number(p, "depth");
        const int domains = number(p, "n");
        const int entry = static_cast<int>(std::lround(std::log2(depth)));
        const int domain = static_cast<int>(std::lround(std::log2(domains)));
        const int bits = depth * (1 + 16 + entry + domain) + domains * (1 + 2 * entry);
        return {laws.area_queue(bits, number(p, "cut"), number(p, "issue")),
                laws.fo4_queue(depth, number(p, "cut"))};
    });
}

TEST(LogicLaws, WidthsAreThoseOfTheSynthesis) {
    expect_points("packing_registers", true, [](const Point& p) -> AreaAndDelay {
        LogicLaws laws;
        laws.task_bits = number(p, "tag");
        constexpr int kPixels = 16;
        return {
            laws.area_packing(number(p, "issue"), kPixels, number(p, "width"), number(p, "writes")),
            laws.fo4_packing(number(p, "issue"), kPixels)};
    });
    const LogicLaws laws;
    expect_points("row_crossbar", true, [&](const Point& p) -> AreaAndDelay {
        return {laws.area_crossbar(number(p, "in"), number(p, "out"), number(p, "tag")), 0};
    });
    expect_points("tile_walk", true, [&](const Point& p) -> AreaAndDelay {
        return {laws.area_tile_walk(number(p, "pairs")), 0};
    });
}

// Twice the pixels are one more level of sums, whichever of the two factors has doubled.
TEST(LogicLaws, ThePackingDelayFollowsTheLogarithmOfThePixels) {
    const LogicLaws laws;
    const double level = laws.fo4_packing(2, 16) - laws.fo4_packing(1, 16);
    EXPECT_GT(level, 0);
    EXPECT_NEAR(laws.fo4_packing(4, 16) - laws.fo4_packing(2, 16), level, 1e-9);
    EXPECT_NEAR(laws.fo4_packing(8, 16) - laws.fo4_packing(1, 16), 3 * level, 1e-9);
    EXPECT_NEAR(laws.fo4_packing(2, 32), laws.fo4_packing(4, 16), 1e-9);
}

// Tasks of 11 bits and 5 of their place; 16 pixels complete up to two packets of 12 lanes, beside
// the one that stays open: 36 lanes and the 12 of that one. Sixteen complete four packets of 4.
TEST(LogicLaws, PacketsThatAreCompleteInPartHaveLanes) {
    LogicLaws laws;
    laws.task_bits = 11;
    laws.packing = {1, 0};
    laws.packing_reach = 0;
    EXPECT_DOUBLE_EQ(laws.area_packing(1, 16, 12, 1), (36 + 12) * 16);
    EXPECT_DOUBLE_EQ(laws.area_packing(1, 16, 4, 1), (20 + 4) * 16);
    EXPECT_DOUBLE_EQ(laws.area_packing(1, 16, 12, 4), (60 + 12) * 16);
}

TEST(LogicLaws, PeAndPixelLoopAreThoseOfTheSynthesis) {
    const LogicLaws laws;
    EXPECT_EQ(std::stod(points_of("pe").front().at("area")), laws.pe_area);
    const std::vector<Point> loops = points_of("pixel_loop");
    ASSERT_EQ(loops.size(), 2U);
    EXPECT_NEAR(std::stod(loops[0].at("fo4")), laws.pixel_loop_fo4, 0.5);
    EXPECT_NEAR(std::stod(loops[1].at("fo4")), laws.tuned_pixel_loop_fo4, 0.5);
}

TEST(ClockEstimate, TheSlowestLogicDecides) {
    const ClockEstimate clock({{"fast", 20, 1, ""}, {"slow", 200, 4, "key=5"}, {"even", 40, 1, ""}},
                              40, 1);
    EXPECT_DOUBLE_EQ(*clock.feasible_ghz(), 0.8);
    const std::string bound = " by synthesis, a bound of this RTL and not of the design";
    EXPECT_EQ(clock.words("28 nm"),
              "our RTL reaches 0.8 of 1 GHz in 28 nm" + bound + ": slow 0.8 (key=5)");
    EXPECT_EQ(ClockEstimate({{"even", 40, 1, ""}}, 40, 1).words("7 nm"),
              "our RTL reaches 1 of 1 GHz in 7 nm" + bound);
    EXPECT_EQ(ClockEstimate({}, 40, 1.5).words("28 nm"),
              "1.5 GHz as configured; there is no RTL of this design");
    EXPECT_FALSE(ClockEstimate({}, 40, 1).feasible_ghz().has_value());
}

// A design that reaches its clock needs no cure, although its slowest logic has one.
TEST(ClockEstimate, ReportsACureOnlyIfItIsNeeded) {
    const auto cure = [](double clock_ghz) {
        const ClockEstimate clock({{"slow", 200, 4, "key=5"}}, 40, clock_ghz);
        const std::vector<Statistic> list =
            list_statistics([&](StatsVisitor& visitor) { clock.describe(visitor); });
        return std::get<std::string>(list.back().value);
    };
    EXPECT_EQ(cure(1), "key=5");
    EXPECT_EQ(cure(0.8), "");
}

} // namespace
} // namespace degs::cost
