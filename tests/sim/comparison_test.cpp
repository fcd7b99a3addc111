// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/comparison.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/compare/comparison_output.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A report with what a comparison reads.
ordered_json report(double ms, double useful, int pes = 64) {
    return {{"scene", {{"name", "toys"}, {"source", "toys.ply"}}},
            {"camera", {{"img_name", "front"}, {"width", 640}, {"height", 480}}},
            {"config", {{"accelerator", "degs"}}},
            {"workload",
             {{"gaussians", 1000}, {"visible", 900}, {"tile_size", 32}, {"fragments", 123456}}},
            {"timing", {{"cycles", ms * 1e6}, {"latency_ms", ms}, {"fps", 1e3 / ms}}},
            {"slots",
             {{"pes", pes},
              {"total", 1000},
              {"useful", useful * 1000},
              {"boundary", 1000 - useful * 1000},
              {"terminated", 0},
              {"conflict", 0},
              {"starved", 0},
              {"blocked", 0},
              {"drain", 0},
              {"utilization", useful},
              {"frame_utilization", useful / 2}}},
            {"dram",
             {{"bytes_read", 3000000},
              {"bytes_written", 1000000},
              {"peak_gb_per_s", 204.8},
              {"utilization", 0.25}}},
            {"area", {{"available", false}, {"why", "unknown"}}},
            {"image", {{"psnr_db", 60.5}, {"ssim", 0.99}, {"max_abs_error", 0.01}}},
            {"host", {{"sim_s", 1.5}}}};
}

ordered_json with_area(ordered_json report, double mm2) {
    report["area"] = {{"mm2", mm2}};
    return report;
}

ordered_json path(double fps) {
    return {{"timing", {{"throughput_fps", fps}}}};
}

double value(const Comparison& comparison, std::size_t row, Measure measure) {
    return comparison.rows.at(row).measures[measure].value();
}

TEST(Compare, RatiosAreAgainstTheFirst) {
    const Comparison c =
        compare({"degs-64", "other"}, {{"degs-64", 2, with_area(report(2, 0.8), 3), path(600)},
                                       {"other", 2, with_area(report(5, 0.2), 6), path(150)}});
    EXPECT_EQ(value(c, 0, Measure::LatencyRatio), 1);
    EXPECT_EQ(value(c, 0, Measure::ThroughputRatioPerArea), 1);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::LatencyRatio), 0.4);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::ThroughputRatio), 0.25);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::LatencyRatioPerArea), 0.2);
    EXPECT_DOUBLE_EQ(value(c, 1, Measure::ThroughputRatioPerArea), 0.125);
    EXPECT_EQ(value(c, 1, Measure::Cycles), 5e6);
    EXPECT_EQ(value(c, 1, Measure::Useful), 0.2);
    EXPECT_EQ(value(c, 1, Measure::Boundary), 0.8);
    EXPECT_EQ(value(c, 1, Measure::DramRead), 3e6);
    EXPECT_TRUE(c.means.empty()); // of one view
    ASSERT_EQ(c.views.size(), 1U);
    EXPECT_EQ(view_words(c.views[0]), "toys · camera 2 · 640×480");
    EXPECT_EQ(c.configs[1].pes, 64);
    EXPECT_EQ(c.configs[1].tile_size, 32);
    EXPECT_EQ(c.configs[1].area_mm2, 6);
}

TEST(Compare, WhatDoesNotExistIsEmpty) {
    ordered_json poor = report(2, 0.5);
    poor["workload"]["fragments"] = nullptr;
    poor["dram"]["peak_gb_per_s"] = nullptr; // memory without limit
    poor["image"] = {{"psnr_db", nullptr}, {"ssim", nullptr}};
    poor["slots"]["total"] = 0; // nothing was blended
    poor["slots"]["utilization"] = nullptr;
    const Comparison c = compare({"a", "b"}, {{"a", 0, poor, {}}, {"b", 0, report(1, 0.5), {}}});
    for (Measure m :
         {Measure::ThroughputFps, Measure::ThroughputRatio, Measure::AreaMm2,
          Measure::LatencyRatioPerArea, Measure::ThroughputRatioPerArea, Measure::DramRead,
          Measure::DramWritten, Measure::DramUtilization, Measure::PsnrDb, Measure::Ssim,
          Measure::MaxAbsError, Measure::Useful, Measure::Drain, Measure::Utilization}) {
        EXPECT_FALSE(c.rows[0].measures[m]) << place_of(m);
    }
    EXPECT_FALSE(c.views[0].fragments);
    EXPECT_EQ(value(c, 1, Measure::LatencyRatio), 2);
    // Area of one alone gives no ratio.
    const Comparison d = compare(
        {"a", "b"}, {{"a", 0, report(1, 0.5), {}}, {"b", 0, with_area(report(1, 0.5), 2), {}}});
    EXPECT_FALSE(d.rows[1].measures[Measure::LatencyRatioPerArea]);
    // Without the first configuration there is nothing to compare with.
    const Comparison e = compare({"a", "b"}, {{"b", 0, report(1, 0.5), {}}});
    EXPECT_FALSE(e.rows[0].measures[Measure::LatencyRatio]);
    EXPECT_TRUE(e.configs[0].accelerator.empty());
    EXPECT_FALSE(e.configs[0].pes);
}

TEST(Compare, MeansAreGeometricAndOfAllViews) {
    const Comparison c = compare({"a", "b"}, {{"a", 0, report(1, 0.5), path(10)},
                                              {"b", 0, report(4, 0.2), path(5)},
                                              {"a", 1, report(9, 0.5), path(10)},
                                              {"b", 1, report(9, 0.8), {}},
                                              {"a", 2, report(3, 0.5), path(10)}});
    ASSERT_EQ(c.views.size(), 3U);
    ASSERT_EQ(c.means.size(), 2U);
    EXPECT_NEAR(c.means[0].measures[Measure::LatencyMs].value(), 3, 1e-12); // cube root of 27
    EXPECT_NEAR(c.means[0].measures[Measure::ThroughputFps].value(), 10, 1e-12);
    EXPECT_NEAR(c.means[0].measures[Measure::LatencyRatio].value(), 1, 1e-12);
    EXPECT_FALSE(c.means[0].measures[Measure::Cycles]);
    EXPECT_FALSE(c.means[1].measures[Measure::LatencyMs]); // b lacks the third view
    const Comparison two = compare({"a", "b"}, {{"a", 0, report(1, 0.5), {}},
                                                {"b", 0, report(4, 0.2), {}},
                                                {"a", 1, report(9, 0.5), {}},
                                                {"b", 1, report(9, 0.8), {}}});
    EXPECT_NEAR(two.means[1].measures[Measure::LatencyRatio].value(), 0.5, 1e-12);
    EXPECT_NEAR(two.means[1].measures[Measure::Utilization].value(), 0.4, 1e-12);
}

TEST(Compare, ViewsDifferBySceneCameraOrSize) {
    ordered_json large = report(1, 0.5);
    large["camera"]["width"] = 1280;
    ordered_json other = report(1, 0.5);
    other["scene"]["source"] = "else/toys.ply";
    const Comparison c = compare({"a"}, {{"a", 0, report(1, 0.5), {}},
                                         {"a", 1, report(1, 0.5), {}},
                                         {"a", 0, large, {}},
                                         {"a", 0, other, {}}});
    EXPECT_EQ(c.views.size(), 4U);
}

TEST(Compare, ARunOfNobodyIsAnError) {
    EXPECT_THROW(compare({"a"}, {{"b", 0, report(1, 0.5), {}}}), std::logic_error);
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
    ordered_json exact = with_area(report(5, 0.2, 256), 6);
    exact["image"]["psnr_db"] = "inf";
    Comparison c = compare({"degs-64", "a,\"b\""},
                           {{"degs-64", 2, report(2, 0.8), path(600)}, {"a,\"b\"", 2, exact, {}}});
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
    for (const ordered_json& run : json["runs"]) {
        for (std::size_t m = 0; m < static_cast<std::size_t>(Measure::Count); ++m) {
            EXPECT_TRUE(run.contains(ordered_json::json_pointer(place_of(static_cast<Measure>(m)))))
                << place_of(static_cast<Measure>(m));
        }
        EXPECT_EQ(run["view"], 0);
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
    ASSERT_EQ(head.size(), 8 + static_cast<std::size_t>(Measure::Count));
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
        compare({"a"}, {{"a", 0, report(1, 0.5), {}}, {"a", 1, report(4, 0.5), {}}});
    EXPECT_THAT(comparison_text(two), HasSubstr("geometric means over 2 views"));
}

TEST(ComparisonOutput, PicturesExistWhenTheyShowSomething) {
    const Comparison c = small_comparison();
    EXPECT_THAT(slots_picture(c), HasSubstr("256 PEs"));
    EXPECT_THAT(slots_picture(c), HasSubstr("500 fps"));
    EXPECT_THAT(utilization_picture(c), HasSubstr(">256<"));
    const Comparison one_size =
        compare({"a", "b"}, {{"a", 0, report(1, 0.5), {}}, {"b", 0, report(1, 0.6), {}}});
    EXPECT_NE(slots_picture(one_size), "");
    EXPECT_EQ(utilization_picture(one_size), "");
    EXPECT_EQ(slots_picture(compare({"a"}, {})), "");
    Comparison arrays = c;
    arrays.array_only = true;
    EXPECT_THAT(slots_picture(arrays), HasSubstr("arrays alone"));
}

} // namespace
} // namespace degs::sim
