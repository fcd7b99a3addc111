// SPDX-License-Identifier: Apache-2.0
#include "sim/results/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/compare/comparison_output.hpp"
#include "sim/results/result_words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// What a run of one frame brings back.
RunSummary run(double ms, double useful, int pes = 64) {
    RunSummary summary;
    summary.accelerator = "degs";
    summary.pes = pes;
    summary.tile_size = 32;
    summary.view = {"toys", "toys.ply", "front", 0, 640, 480, 1000, 900, 123456};
    Measures& m = summary.measures;
    m[Measure::Cycles] = ms * 1e6;
    m[Measure::LatencyMs] = ms;
    m[Measure::Fps] = 1e3 / ms;
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        m[slot_measure(kSlotClasses[c].slot)] = 0;
    }
    m[slot_measure(Slot::Useful)] = useful;
    m[slot_measure(Slot::Boundary)] = 1 - useful;
    m[Measure::Utilization] = useful;
    m[Measure::FrameUtilization] = useful / 2;
    m[Measure::DramRead] = 3000000;
    m[Measure::DramWritten] = 1000000;
    m[Measure::DramUtilization] = 0.25;
    m[Measure::NjPerFrame] = 4e6 / ms;
    m[Measure::NjPerPixel] = 4;
    m[Measure::AveragePowerW] = 2;
    m[Measure::PsnrDb] = 60.5;
    m[Measure::Ssim] = 0.99;
    m[Measure::MaxAbsError] = 0.01;
    m[Measure::SimS] = 1.5;
    return summary;
}

RunSummary with_area(RunSummary summary, double mm2) {
    summary.measures[Measure::AreaMm2] = mm2;
    return summary;
}

RunSummary of_camera(int camera, RunSummary summary) {
    summary.view.camera = camera;
    return summary;
}

/// A run of a camera path; its latency is that of a frame that others follow.
RunSummary path(double fps) {
    RunSummary summary = run(99, 0.5);
    summary.measures[Measure::ThroughputFps] = fps;
    return summary;
}

double value(const Comparison& comparison, std::size_t row, Measure measure) {
    return comparison.rows.at(row).measures[measure].value();
}

TEST(Compare, RatiosAreAgainstTheFirst) {
    const Comparison c = compare({"degs-64", "other"},
                                 {{"degs-64", of_camera(2, with_area(run(2, 0.8), 3)), path(600)},
                                  {"other", of_camera(2, with_area(run(5, 0.2), 6)), path(150)}});
    EXPECT_EQ(value(c, 0, Measure::LatencyRatio), 1);
    EXPECT_EQ(value(c, 0, Measure::ThroughputRatioPerArea), 1);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::LatencyRatio), 0.4);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::ThroughputRatio), 0.25);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::LatencyRatioPerArea), 0.2);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::ThroughputRatioPerArea), 0.125);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::EnergyRatio), 2.5);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::EnergyRatioPerArea), 1.25);
    EXPECT_EQ(value(c, 1, Measure::Cycles), 5e6);
    EXPECT_EQ(value(c, 1, slot_measure(Slot::Useful)), 0.2);
    EXPECT_EQ(value(c, 1, slot_measure(Slot::Boundary)), 0.8);
    EXPECT_EQ(value(c, 1, Measure::DramRead), 3e6);
    EXPECT_TRUE(c.means.empty()); // of one view
    ASSERT_EQ(c.views.size(), 1U);
    EXPECT_EQ(view_words(c.views[0]), "toys · camera 2 · 640×480");
    EXPECT_EQ(c.configs[1].pes, 64);
    EXPECT_EQ(c.configs[1].tile_size, 32);
    EXPECT_EQ(c.configs[1].area_mm2, 6);
}

TEST(Compare, WhatDoesNotExistIsEmpty) {
    RunSummary poor = run(2, 0.5);
    poor.measures = {};
    poor.measures[Measure::LatencyMs] = 2;
    poor.view.fragments.reset();
    const Comparison c = compare({"a", "b"}, {{"a", poor, {}}, {"b", run(1, 0.5), {}}});
    for (Measure m :
         {Measure::ThroughputFps, Measure::ThroughputRatio, Measure::AreaMm2,
          Measure::LatencyRatioPerArea, Measure::ThroughputRatioPerArea, Measure::DramRead,
          Measure::DramWritten, Measure::DramUtilization, Measure::PsnrDb, Measure::Ssim,
          Measure::MaxAbsError, slot_measure(Slot::Useful), slot_measure(Slot::Drain),
          Measure::Utilization}) {
        EXPECT_FALSE(c.rows[0].measures[m]) << name_of(m);
    }
    EXPECT_FALSE(c.views[0].fragments);
    EXPECT_EQ(value(c, 1, Measure::LatencyRatio), 2);
    // Area of one alone gives no ratio.
    const Comparison d =
        compare({"a", "b"}, {{"a", run(1, 0.5), {}}, {"b", with_area(run(1, 0.5), 2), {}}});
    EXPECT_FALSE(d.rows[1].measures[Measure::LatencyRatioPerArea]);
    // Without the first configuration there is nothing to compare with.
    const Comparison e = compare({"a", "b"}, {{"b", run(1, 0.5), {}}});
    EXPECT_FALSE(e.rows[0].measures[Measure::LatencyRatio]);
    EXPECT_TRUE(e.configs[0].accelerator.empty());
    EXPECT_FALSE(e.configs[0].pes);
}

TEST(Compare, MeansAreGeometricAndOfAllViews) {
    const Comparison c = compare({"a", "b"}, {{"a", run(1, 0.5), path(10)},
                                              {"b", run(4, 0.2), path(5)},
                                              {"a", of_camera(1, run(9, 0.5)), path(10)},
                                              {"b", of_camera(1, run(9, 0.8)), {}},
                                              {"a", of_camera(2, run(3, 0.5)), path(10)}});
    ASSERT_EQ(c.views.size(), 3U);
    ASSERT_EQ(c.means.size(), 2U);
    EXPECT_NEAR(c.means[0].measures[Measure::LatencyMs].value(), 3, 1e-12); // cube root of 27
    EXPECT_NEAR(c.means[0].measures[Measure::ThroughputFps].value(), 10, 1e-12);
    EXPECT_NEAR(c.means[0].measures[Measure::LatencyRatio].value(), 1, 1e-12);
    EXPECT_FALSE(c.means[0].measures[Measure::Cycles]);
    EXPECT_FALSE(c.means[1].measures[Measure::LatencyMs]); // b lacks the third view
    const Comparison two = compare({"a", "b"}, {{"a", run(1, 0.5), {}},
                                                {"b", run(4, 0.2), {}},
                                                {"a", of_camera(1, run(9, 0.5)), {}},
                                                {"b", of_camera(1, run(9, 0.8)), {}}});
    EXPECT_NEAR(two.means[1].measures[Measure::LatencyRatio].value(), 0.5, 1e-12);
    EXPECT_NEAR(two.means[1].measures[Measure::Utilization].value(), 0.4, 1e-12);
}

TEST(Compare, ViewsDifferBySceneCameraOrSize) {
    RunSummary large = run(1, 0.5);
    large.view.width = 1280;
    RunSummary other = run(1, 0.5);
    other.view.source = "else/toys.ply";
    const Comparison c = compare({"a"}, {{"a", run(1, 0.5), {}},
                                         {"a", of_camera(1, run(1, 0.5)), {}},
                                         {"a", large, {}},
                                         {"a", other, {}}});
    EXPECT_EQ(c.views.size(), 4U);
}

TEST(Compare, ARunOfNobodyIsAnError) {
    EXPECT_THROW(compare({"a"}, {{"b", run(1, 0.5), {}}}), std::logic_error);
    EXPECT_TRUE(compare({"a"}, {}).rows.empty());
}

TEST(Compare, FamiliesLeaveOutThePes) {
    const auto family = [](const char* name, std::optional<int> pes) {
        ComparedConfig config;
        config.name = name;
        config.pes = pes;
        return family_of(config);
    };
    EXPECT_EQ(family("degs-64", 64), "degs");
    EXPECT_EQ(family("degs_1024", 1024), "degs");
    EXPECT_EQ(family("degs-64-tuned", 64), "degs-tuned");
    EXPECT_EQ(family("degs-640", 64), "degs-640");
    EXPECT_EQ(family("-64", 64), "-64");
    EXPECT_EQ(family("degs-64", {}), "degs-64");
    EXPECT_EQ(family("mine", 64), "mine");
}

Comparison small_comparison() {
    RunSummary exact = with_area(run(5, 0.2, 256), 6);
    exact.measures[Measure::PsnrDb] = std::numeric_limits<double>::infinity();
    Comparison c =
        compare({"degs-64", "a,\"b\""}, {{"degs-64", of_camera(2, run(2, 0.8)), path(600)},
                                         {"a,\"b\"", of_camera(2, exact), {}}});
    c.frames = 4;
    c.path_step_degrees = 0.5;
    c.failed = {{"gcc-64", "toys · camera 2 · 640×480", "No."}};
    return c;
}

TEST(ComparisonOutput, JsonHasEveryMeasureInEveryRun) {
    const ordered_json json = comparison_json(small_comparison());
    EXPECT_EQ(json["schema"]["name"], "degs-compare");
    EXPECT_EQ(json["schema"]["version"], kComparisonVersion);
    EXPECT_EQ(json["frames"], 4);
    EXPECT_EQ(json["path_step_degrees"], 0.5);
    ASSERT_EQ(json["runs"].size(), 2U);
    for (const ordered_json& row : json["runs"]) {
        for_each_measure([&row](Measure m) {
            std::string place = "/" + name_of(m);
            std::replace(place.begin(), place.end(), '.', '/');
            EXPECT_TRUE(row.contains(ordered_json::json_pointer(place))) << place;
        });
        EXPECT_EQ(row["view"], 0);
    }
    EXPECT_EQ(json["runs"][0]["cycles"].dump(), "2000000"); // a count, not 2000000.0
    EXPECT_TRUE(json["runs"][0]["area_mm2"].is_null());
    EXPECT_EQ(json["runs"][1]["image"]["psnr_db"], "inf");
    EXPECT_EQ(json["configs"][1]["area_mm2"], 6);
    EXPECT_EQ(json["views"][0]["camera"], 2);
    EXPECT_EQ(json["failed"][0]["why"], "No.");
    EXPECT_TRUE(json["means"].empty());
}

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts(1);
    for (char c : text) {
        if (c == at) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

TEST(ComparisonOutput, CsvHasARowPerRun) {
    const std::vector<std::string> lines = split(comparison_csv(small_comparison()), '\n');
    ASSERT_EQ(lines.size(), 4U); // the last is what follows the last newline
    EXPECT_EQ(lines[3], "");
    const std::vector<std::string> head = split(lines[0], ',');
    const std::vector<std::string> first = split(lines[1], ',');
    ASSERT_EQ(head.size(), 9 + kMeasures);
    ASSERT_EQ(first.size(), head.size());
    const auto cell = [&](const std::string& column) {
        return first.at(
            static_cast<std::size_t>(std::find(head.begin(), head.end(), column) - head.begin()));
    };
    EXPECT_EQ(cell("config"), "degs-64");
    EXPECT_EQ(cell("cycles"), "2000000");
    EXPECT_EQ(cell("slots.useful"), "0.8");
    EXPECT_EQ(cell("area_mm2"), "");
    EXPECT_EQ(cell("ratio.latency_per_mm2"), "");
    EXPECT_EQ(lines[2].rfind("\"a,\"\"b\"\"\",degs,256,32,toys,2,640,480,", 0), 0U) << lines[2];
    EXPECT_THAT(lines[2], HasSubstr(",inf,"));
}

TEST(ComparisonOutput, TextShowsWhatThereIs) {
    const std::string text = comparison_text(small_comparison());
    for (const char* words :
         {"toys · camera 2 · 640×480", "123 k fragments", "degs-64", "identical", "path fps",
          "0.40", "80.0", "4 frames of 0.5°", "degs-64 = 1", "mm²"}) {
        EXPECT_THAT(text, HasSubstr(words));
    }
    EXPECT_THAT(text, Not(HasSubstr("speed/mm²"))); // no ratio of areas exists
    EXPECT_EQ(comparison_text(compare({"a"}, {})), "");
    const Comparison two =
        compare({"a"}, {{"a", run(1, 0.5), {}}, {"a", of_camera(1, run(4, 0.5)), {}}});
    EXPECT_THAT(comparison_text(two), HasSubstr("geometric means over 2 views"));
}

/// The cell of a row in the table that has the heading, whose columns two blanks keep apart.
std::string cell_in(const std::string& text, const std::string& heading, const std::string& row) {
    const std::regex gap(" {2,}");
    const auto cells = [&gap](const std::string& line) {
        return std::vector<std::string>(
            std::sregex_token_iterator(line.begin(), line.end(), gap, -1), {});
    };
    std::optional<std::ptrdiff_t> from_right; // the first column may have no heading
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::vector<std::string> all = cells(line);
        const auto at = std::find(all.begin(), all.end(), heading);
        from_right = at != all.end() ? std::optional(all.end() - at) : from_right;
        if (from_right && all.front() == row) {
            return all.at(all.size() - static_cast<std::size_t>(*from_right));
        }
    }
    return "";
}

TEST(ComparisonOutput, TablesHaveTheirUnits) {
    Comparison c = small_comparison();
    c.rows[0].measures[Measure::DramRead] = 2.5e6;
    c.rows[1].cycles_low = 4.5e6; // of 5e6
    c.rows[1].cycles_high = 5.5e6;
    const std::string text = comparison_text(c);
    EXPECT_EQ(cell_in(text, "DRAM MB", "degs-64"), "3.50");
    EXPECT_EQ(cell_in(text, "cycles", "a,\"b\""), "5.00 M ±10.0 %");
    EXPECT_EQ(cell_in(text, "mJ", "degs-64"), "2.00");
}

// Half of the area of the second design takes twice as long and twice the energy.
TEST(ComparisonOutput, EqualAreaScalesTimeAndEnergy) {
    const Comparison c = compare({"a", "b"}, {{"a", with_area(run(2, 0.8), 3), path(600)},
                                              {"b", with_area(run(5, 0.2), 6), path(150)}});
    const std::string text = equal_area_text(c);
    EXPECT_EQ(cell_in(text, "area ×", "b"), "0.50");
    EXPECT_EQ(cell_in(text, "ms", "b"), "10.0");
    EXPECT_EQ(cell_in(text, "path fps", "b"), "75.0");
    EXPECT_EQ(cell_in(text, "mJ", "b"), "1.60");
    EXPECT_EQ(cell_in(text, "speed ×", "b"), "0.20");
}

TEST(ComparisonOutput, CellsWithTheEndOfALineAreQuoted) {
    for (const char* cell : {"a,b", "a\nb", "a\r\nb"}) {
        EXPECT_EQ(csv_cell(cell), "\"" + std::string(cell) + "\"");
    }
    EXPECT_EQ(csv_cell("a b"), "a b");
    EXPECT_EQ(csv_cell("a\rb"), "a\\rb"); // a line that would be written over
}

TEST(ComparisonOutput, LinesOfUtilizationAreOfOneView) {
    const Comparison c =
        compare({"degs-64", "degs-256"}, {{"degs-64", run(4, 0.5, 64), {}},
                                          {"degs-256", run(2, 0.4, 256), {}},
                                          {"degs-64", of_camera(1, run(4, 0.5, 64)), {}},
                                          {"degs-256", of_camera(1, run(2, 0.4, 256)), {}}});
    const std::string svg = utilization_picture(c);
    const std::regex points("<circle");
    EXPECT_EQ(std::distance(std::sregex_iterator(svg.begin(), svg.end(), points), {}),
              1 + 2 + 2); // one in the legend, and two in each panel
}

/// What stands between the brackets behind a key of the data of a page.
std::string list_in(const std::string& page, const std::string& key) {
    const std::string begin = "\"" + key + "\":[";
    const std::size_t at = page.find(begin) + begin.size();
    return page.substr(at, page.find(']', at) - at);
}

TEST(ComparisonOutput, ThePageHasTheKeysInWhichDesignsDiffer) {
    const std::vector<NamedConfig> configs{
        {"g", default_run_config("gscore", {})},
        {"a", default_run_config("degs", {"clock_ghz=2"})},
        {"b", default_run_config("degs", {"clock_ghz=2", "span.count=3"})}};
    const std::string page = comparison_page(
        configs, compare({"g", "a", "b"}, {{"g", run(1, 0.5), {}}, {"a", run(1, 0.5), {}}}));
    const std::string keys = list_in(page, "keys");
    EXPECT_THAT(keys, HasSubstr("\"clock_ghz\""));      // of the first and the others
    EXPECT_THAT(keys, HasSubstr("\"span.count\""));     // of the second and the third
    EXPECT_THAT(keys, Not(HasSubstr("slicing.count"))); // the first has none, the others agree
}

TEST(ComparisonOutput, ThePageHasNoWordThatEndsItsData) {
    RunSummary hostile = run(1, 0.5);
    hostile.view.scene = "<a></script><b></script>";
    const std::string page = comparison_page({{"a", default_run_config("degs", {})}},
                                             compare({"a"}, {{"a", hostile, {}}}));
    EXPECT_EQ(page.find("</script><b>"), std::string::npos);
    EXPECT_EQ(page.find("<b>"), std::string::npos);
}

TEST(ComparisonOutput, PicturesExistWhenTheyShowSomething) {
    const Comparison c = small_comparison();
    EXPECT_THAT(slots_picture(c), HasSubstr("256 PEs"));
    EXPECT_THAT(slots_picture(c), HasSubstr("500 fps"));
    EXPECT_THAT(utilization_picture(c), HasSubstr(">256<"));
    const Comparison one_size =
        compare({"a", "b"}, {{"a", run(1, 0.5), {}}, {"b", run(1, 0.6), {}}});
    EXPECT_NE(slots_picture(one_size), "");
    EXPECT_EQ(utilization_picture(one_size), "");
    EXPECT_EQ(slots_picture(compare({"a"}, {})), "");
    Comparison arrays = c;
    arrays.array_only = true;
    EXPECT_THAT(slots_picture(arrays), HasSubstr("arrays alone"));
}

} // namespace
} // namespace degs::sim
