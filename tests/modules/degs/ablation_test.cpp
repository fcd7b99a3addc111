// SPDX-License-Identifier: Apache-2.0
// What span parsing and the reorganisation of tasks are for: the same frames without them.
#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::DegsRun;
using test::exact_arithmetic;
using test::make_frame;
using test::Shape;

DegsConfig ablated(const Shape& shape, bool parsing, bool reorganisation) {
    DegsConfig config = test::shaped(exact_arithmetic(), shape);
    config.span.parsing = parsing;
    config.packing.reorganisation = reorganisation;
    return config;
}

/// All pixels at most `radius` px from the centre.
ProjectedSplat disc(double x, double y, double radius) {
    const double opacity = 0.5;
    const double sigma = radius / std::sqrt(2 * std::log(opacity * 255));
    return test::make_splat(x, y, sigma, sigma, 0, opacity);
}

/// A run of each combination, whose order is: both, parsing alone, reorganisation alone, neither.
std::vector<std::unique_ptr<DegsRun>> run_all(const Shape& shape, const FrameWorkload& frame) {
    std::vector<std::unique_ptr<DegsRun>> runs;
    for (const bool parsing : {true, false}) {
        for (const bool reorganisation : {true, false}) {
            const std::string name = "run" + std::to_string(runs.size());
            runs.push_back(std::make_unique<DegsRun>(name.c_str(),
                                                     ablated(shape, parsing, reorganisation),
                                                     std::vector<const FrameWorkload*>{&frame}));
        }
    }
    sc_core::sc_start();
    for (const auto& run : runs) {
        test::expect_sound(*run);
        test::expect_reference(*run);
    }
    return runs;
}

void expect_tasks(const DegsRun& run, std::uint64_t useful, std::uint64_t boundary) {
    EXPECT_EQ(run.span_tasks(), useful + boundary);
    EXPECT_EQ(run.slots()[Slot::Useful], useful);
    EXPECT_EQ(run.slots()[Slot::Boundary], boundary);
    EXPECT_EQ(run.slots()[Slot::Terminated], 0U);
}

// Five rows of a disc with a radius of 2.2 px: 1, 3, 5, 3 and 1 of the 5 columns of its box.
TEST(SmallRunAblation, WithoutParsingARowTakesAllPixelsOfTheBox) {
    const FrameWorkload frame = make_frame({disc(8, 8, 2.2)}, 16, 16, 16);
    const auto runs = run_all({16, 2, 8, 8, 8}, frame);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        SCOPED_TRACE(i);
        const bool parsing = i < 2;
        expect_tasks(*runs[i], 13, parsing ? 0 : 12);
        EXPECT_EQ(runs[i]->packets(),
                  5U); // one for each of the rows, which have banks of their own
        for (int row = 6; row <= 10; ++row) {
            const std::uint64_t solved = 5 - 2 * std::abs(row - 8);
            EXPECT_EQ(runs[i]->degs().banks()[row % 8]->stats().tasks_in, parsing ? solved : 5U);
        }
    }
}

// A disc across two tiles, which have 3 and 2 of the columns.
TEST(SmallRunAblation, WithoutParsingTheTileCutsTheBox) {
    const FrameWorkload frame = make_frame({disc(15, 8, 2.2)}, 32, 16, 16);
    const auto runs = run_all({16, 2, 8, 8, 8}, frame);
    expect_tasks(*runs[0], 13, 0);
    expect_tasks(*runs[2], 13, 12);
    EXPECT_EQ(runs[2]->packets(), 10U);
}

// A disc on two rows of one pixel each, which reach the only bank in the same cycle.
TEST(SmallRunAblation, WithoutReorganisationTwoSpansTakeTwoPackets) {
    const FrameWorkload frame = make_frame({disc(3, 2.5, 0.9)}, 16, 16, 16);
    const auto runs = run_all({16, 1, 2, 1, 8}, frame);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        SCOPED_TRACE(i);
        const std::uint64_t packets = i % 2 == 0 ? 1 : 2;
        expect_tasks(*runs[i], 2, 0);
        EXPECT_EQ(runs[i]->packets(), packets);
        EXPECT_EQ(runs[i]->window().cycles(), packets);
        EXPECT_EQ(runs[i]->slots()[Slot::Blocked], i % 2 == 0 ? 0U : 7U); // the first one is closed
    }
}

// A span of 4 + 4 pixels in two segments is still one packet.
TEST(SmallRunAblation, WithoutReorganisationASpanIsStillCompacted) {
    const FrameWorkload frame = make_frame({test::one_row(12, 19, 2)}, 32, 32, 32);
    const auto runs = run_all({32, 2, 8, 8, 8}, frame);
    for (const auto& run : runs) {
        expect_tasks(*run, 8, 0);
        EXPECT_EQ(run->packets(), 1U);
    }
}

// Work only grows with what is switched off; the image stays.
TEST(SmallRunAblation, EachMechanismSavesPackets) {
    const FrameWorkload frame = test::random_frame(7, 90, 70, 32, 200);
    const auto runs = run_all({32, 2, 8, 8, 8}, frame);
    EXPECT_EQ(runs[0]->slots()[Slot::Boundary], 0U);
    EXPECT_EQ(runs[1]->slots()[Slot::Boundary], 0U);
    EXPECT_GT(runs[2]->slots()[Slot::Boundary], runs[0]->slots()[Slot::Useful] / 3);
    EXPECT_LT(runs[0]->packets(), runs[1]->packets());
    EXPECT_LT(runs[0]->packets(), runs[2]->packets());
    EXPECT_LT(runs[2]->packets(), runs[3]->packets());
    EXPECT_LT(runs[0]->window().cycles(), runs[1]->window().cycles());
    EXPECT_LT(runs[0]->window().cycles(), runs[2]->window().cycles());
}

// Hazards reach the pixels of testing PEs, too: every update sees the state four cycles before it.
TEST(SmallRunAblation, WithoutScoreboardTestedPixelsReadTheOlderState) {
    std::vector<ProjectedSplat> splats(40, test::one_pixel(3, 2, 0.02));
    const FrameWorkload frame = make_frame(splats, 16, 16, 16);
    DegsConfig config = ablated({16, 2, 8, 8, 1}, false, true);
    config.scheduler.scoreboard = false;
    config.scheduler.queue_segments_per_pe = 64;
    config.packing.lead_packets = 40;
    const DegsRun run("run", config, {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    EXPECT_EQ(run.hazards(), 39U);
    EXPECT_NEAR(run.image().transmittance[run.image().at(3, 2)], std::pow(0.98, 10), 1e-6);
}

} // namespace
} // namespace degs
