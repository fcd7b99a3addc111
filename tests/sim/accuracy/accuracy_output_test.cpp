// SPDX-License-Identifier: Apache-2.0
// Tables and pictures of the accuracy of numbers, of rows made by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "accuracy/hard/hard_cases.hpp"
#include "sim/accuracy/accuracy.hpp"
#include "sim/accuracy/hard_case_run.hpp"

namespace degs::sim {
namespace {

using testing::HasSubstr;

TEST(AccuracyTable, FlipsAreAShareOfThePixels) {
    AccuracyRow row;
    row.scene = "random";
    row.gaussians = 2;
    row.support = 400;
    row.flips = 1;
    EXPECT_THAT(accuracy_table({row}), HasSubstr(" 0.2500 ")); // %
}

TEST(AccuracyPlot, HasRoomForTheLowestRow) {
    std::vector<AccuracyRow> rows(2);
    for (AccuracyRow& row : rows) {
        row.scene = "s";
        row.numbers = "fp16";
        row.span_ends = "exact";
        row.resolution = "64x48";
        row.psnr_db = 15;
    }
    rows[1].psnr_db = 61;
    const std::string svg = accuracy_svg(rows);
    for (const char* tick : {">0<", ">20<", ">40<", ">60<", ">80<"}) {
        EXPECT_THAT(svg, HasSubstr(tick));
    }
}

TEST(HardCaseTable, SaysNoIfOneResolutionFails) {
    HardResult result;
    result.hard = &hard_cases().front();
    HardMeasure bad, good;
    bad.set = good.set = "fp16";
    bad.resolution = "720p";
    good.resolution = "1080p";
    bad.psnr_db = 41;
    good.psnr_db = 62;
    bad.max_abs_error = good.max_abs_error = 0.5;
    bad.problems = {"A transmittance leaves 10^-4 to 1."};
    result.measures = {bad, good};
    EXPECT_THAT(hard_case_markdown({result}), HasSubstr("| no | no: 41 62, 5e-01 |"));
    result.measures = {good};
    EXPECT_THAT(hard_case_markdown({result}), HasSubstr("| yes | 62, 5e-01 |"));
}

} // namespace
} // namespace degs::sim
