// SPDX-License-Identifier: Apache-2.0
#include "sim/results/run_summary.hpp"

#include <limits>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace degs::sim {
namespace {

using testing::HasSubstr;

RunResult some_result() {
    RunResult result;
    result.scene.name = "two words\nand a line 12";
    result.scene.source = "";
    result.camera.width = 640;
    result.camera.height = 480;
    result.workload.gaussians = 1000;
    result.workload.tile_size = 32;
    result.accelerator.pes = 64;
    result.accelerator.cycles = 3000;
    result.accelerator.frames = {{100, 3000}};
    result.accelerator.slots[Slot::Useful] = 192;
    result.accelerator.slots[Slot::Drain] = 64;
    result.accelerator.window.include(10);
    result.accelerator.window.include(13);
    result.accelerator.memory_gb_per_s = 204.8;
    result.accelerator.memory_utilization = 1.0 / 3;
    result.error = ImageError{std::numeric_limits<double>::infinity(), 1, 0};
    result.workload.reference = ReferenceCounts{192, 0};
    result.changes = FrameChanges{0.5, {}, 827, 0.25};
    return result;
}

/// Why a message is refused; empty if it is not.
std::string refusal(const std::string& message) {
    try {
        summary_from(message);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

std::string without(std::string message, const std::string& field) {
    const std::size_t at = message.find("\n" + field + " ");
    EXPECT_NE(at, std::string::npos) << field;
    const std::size_t line = message.find('\n', at + 1);
    const std::size_t bytes = std::stoul(message.substr(at + 2 + field.size()));
    return message.erase(at, line + 1 + bytes - at);
}

TEST(RunSummary, EveryFieldComesBack) {
    RunSummary sent = summary_of(some_result(), 7);
    sent.report = "{\n}\n";
    sent.limited_by = "memory";
    sent.parts = {{"buffers.b.high_water", 3}, {"energy.blocks.b.nj_per_frame", 0.5}};
    sent.warnings = {"One sentence.", "Another one."};
    const RunSummary back = summary_from(message_of(sent));
    EXPECT_EQ(back.accelerator, "degs");
    EXPECT_EQ(back.pes, 64);
    EXPECT_EQ(back.tile_size, 32);
    EXPECT_EQ(back.view.scene, "two words\nand a line 12");
    EXPECT_EQ(back.view.source, "");
    EXPECT_EQ(back.view.camera, 7);
    EXPECT_EQ(back.view.width, 640);
    EXPECT_EQ(back.view.fragments, 192U);
    const FrameChanges changes = back.view.changes.value();
    EXPECT_EQ(changes.active_overlap, 0.5);
    EXPECT_FALSE(changes.tile_churn);
    EXPECT_EQ(changes.p99_tile_candidates, 827);
    EXPECT_EQ(changes.footprint_gini, 0.25);
    EXPECT_NEAR(back.first_task_ms.value_or(0), 10e-6, 1e-12);
    EXPECT_NEAR(back.last_task_ms.value_or(0), 14e-6, 1e-12);
    EXPECT_EQ(back.limited_by, "memory");
    EXPECT_EQ(back.parts, sent.parts);
    EXPECT_EQ(back.report, sent.report);
    EXPECT_EQ(back.warnings, sent.warnings);
    for_each_measure(
        [&](Measure m) { EXPECT_EQ(back.measures[m], sent.measures[m]) << name_of(m); });
    EXPECT_EQ(message_of(back), message_of(sent));
}

TEST(RunSummary, MeasuresAreTheStatistics) {
    const Measures m = measures_of(some_result());
    EXPECT_EQ(m[Measure::Cycles], 3000);
    EXPECT_EQ(m[Measure::LatencyMs], 0.003);
    EXPECT_EQ(m[slot_measure(Slot::Useful)], 0.75);
    EXPECT_EQ(m[slot_measure(Slot::Drain)], 0.25);
    EXPECT_EQ(m[Measure::Utilization], 0.75);
    EXPECT_EQ(m[Measure::DramUtilization], 1.0 / 3);
    EXPECT_EQ(m[Measure::PsnrDb], std::numeric_limits<double>::infinity());
    EXPECT_FALSE(m[Measure::ThroughputFps]); // of one frame
    EXPECT_FALSE(m[Measure::LatencyRatio]);  // nothing to compare with
    RunResult unlimited = some_result();
    unlimited.accelerator.memory_gb_per_s = 0;
    unlimited.error.reset();
    for (const Measure each : {Measure::DramRead, Measure::DramWritten, Measure::DramUtilization}) {
        EXPECT_FALSE(measures_of(unlimited)[each]) << name_of(each);
    }
    EXPECT_FALSE(measures_of(unlimited)[Measure::Ssim]);
}

TEST(RunSummary, NamesAreDifferent) {
    std::set<std::string> names;
    for_each_measure([&names](Measure m) { EXPECT_TRUE(names.insert(name_of(m)).second); });
    EXPECT_EQ(names.count("slots.useful"), 1U);
}

TEST(HostileRunSummary, WhatIsNotWholeIsRefusedByName) {
    const std::string message = message_of(summary_of(some_result(), 0));
    ASSERT_EQ(refusal(message), "");
    EXPECT_THAT(refusal(without(message, "measure.latency_ms")),
                HasSubstr("'measure.latency_ms' is missing"));
    EXPECT_THAT(refusal(without(message, "view.scene")), HasSubstr("'view.scene' is missing"));
    EXPECT_THAT(refusal(message + "colour 3\nred\n"), HasSubstr("'colour' is unknown"));
    EXPECT_THAT(refusal(without(message, "pes") + "pes 4\nmany\n"),
                HasSubstr("'pes' is not a number"));
    EXPECT_THAT(refusal(without(message, "pes") + "pes 0\n\n"), HasSubstr("'pes' is not a number"));
    EXPECT_THAT(refusal(message + "colour 9999999999\nred\n"), HasSubstr("'colour' is cut off"));
    EXPECT_THAT(refusal(message + "colour"), HasSubstr("cut off"));
    EXPECT_THAT(refusal("degs-run-summary 0\n" + message.substr(message.find('\n') + 1)),
                HasSubstr("degs-run-summary " + std::to_string(kSummaryVersion)));
    for (std::size_t size = 0; size < message.size(); ++size) {
        EXPECT_NE(refusal(message.substr(0, size)), "") << size;
    }
}

} // namespace
} // namespace degs::sim
