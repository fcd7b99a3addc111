// SPDX-License-Identifier: Apache-2.0
// What a person reads after a run, of results made by hand.
#include "sim/report/terminal.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/report/measures.hpp"
#include "sim/report/view_words.hpp"
#include "sim/results/run_summary.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using testing::HasSubstr;

/// The energy of a design that does nothing but leak for a second, of so many frames.
cost::RunEnergy leakage(const RunConfig& config, std::uint64_t frames) {
    const cost::BillOfMaterials bill = config.accelerator().bill();
    cost::RunFacts facts;
    for (const cost::Block& block : bill.blocks()) {
        facts.activity.push_back({block.name, 0});
    }
    facts.seconds = 1;
    facts.frames = frames;
    return {bill, facts};
}

/// Two frames of two cycles per ns: the first is there after 1 ms, both after 3 ms.
RunResult two_frames() {
    RunResult result;
    result.camera.width = 100;
    result.camera.height = 50;
    result.workload.gaussians = 1000;
    result.workload.visible = 96;
    result.workload.reference = ReferenceCounts{192, 0};
    AcceleratorResult& run = result.accelerator;
    run.pes = 64;
    run.clock_ghz = 2;
    run.cycles = run.memory_window = 6000000;
    run.frames = {{0, 2000000}, {0, 6000000}};
    run.window.include(0);
    run.window.include(5999999);
    run.slots[Slot::Useful] = 300;
    run.slots[Slot::Blocked] = 100;
    run.energy = leakage(result.config, 2);
    return result;
}

TEST(Summary, LatencyIsOfTheFirstFrame) {
    EXPECT_THAT(summary(two_frames(), "i.exr"), HasSubstr("100×50 · 1.00 ms · 1000 fps"));
}

TEST(Summary, FragmentsPerSplatAreOfVisibleSplats) {
    EXPECT_THAT(summary(two_frames(), "i.exr"), HasSubstr("2.00 per visible splat"));
    EXPECT_EQ(measures_of(two_frames())[Measure::FragmentsPerSplat], 2);
}

TEST(Summary, NamesTheBuffersThatCameNearestToTheirCapacity) {
    RunResult result = two_frames();
    for (const auto& [name, depth, most] :
         {std::tuple("large", 1000, 500), std::tuple("small", 4, 4), std::tuple("none", 0, 0)}) {
        BufferUse buffer;
        buffer.name = name;
        buffer.depth = depth;
        buffer.high_water = most;
        result.accelerator.buffers.push_back(buffer);
    }
    EXPECT_THAT(summary(result, "i.exr"),
                HasSubstr("fullest small 4 of 4 · large 500 of 1 000 cells"));
}

// A quarter of 4096 bytes and nine tenths of 1024; cells without bytes are not named.
TEST(Summary, NamesTheBytesThatWereNeverFilled) {
    RunResult result = two_frames();
    for (const auto& [name, bytes, depth, most] :
         {std::tuple("less", 1024, 10, 1), std::tuple("most", 4096, 4, 3),
          std::tuple("full", 500, 4, 4), std::tuple("cells", 0, 8, 2)}) {
        BufferUse buffer;
        buffer.name = name;
        buffer.bytes = bytes;
        buffer.depth = depth;
        buffer.high_water = most;
        result.accelerator.buffers.push_back(buffer);
    }
    EXPECT_THAT(summary(result, "i.exr"),
                HasSubstr(" cells; never filled: 1.00 KB of most, 0.899 KB of less\n"));
}

TEST(Summary, SharesOfTheEnergyHaveLeakage) {
    const RunResult result = two_frames();
    const auto& blocks = result.accelerator.energy.blocks();
    const auto most =
        std::max_element(blocks.begin(), blocks.end(),
                         [](const auto& a, const auto& b) { return a.leakage_nj < b.leakage_nj; });
    ASSERT_GT(most->leakage_nj, 0);
    EXPECT_THAT(summary(result, "i.exr"),
                HasSubstr(most->name + " " +
                          percent(most->leakage_nj / result.accelerator.energy.leakage_nj(), 0) +
                          " %"));
}

TEST(Summary, EnergyOfABlockIsPerFrame) {
    const RunResult result = two_frames();
    const RunSummary summary = summary_of(result, 0);
    const cost::BlockEnergy& first = result.accelerator.energy.blocks().front();
    const auto part = std::find_if(summary.parts.begin(), summary.parts.end(), [&](const auto& p) {
        return p.first == "energy.blocks." + first.name + ".nj_per_frame";
    });
    ASSERT_NE(part, summary.parts.end());
    EXPECT_DOUBLE_EQ(part->second, first.leakage_nj / 2);
}

TEST(Summary, AViewHasItsShareOfTheBytes) {
    RunResult result = two_frames();
    AcceleratorResult& run = result.accelerator;
    run.frames.resize(1);
    result.views.resize(4);
    run.views.resize(4);
    run.streams.resize(1);
    run.streams[0].bytes_read = 4000000;
    run.streams[0].bytes_written = 8000000;
    EXPECT_THAT(views_words(result), HasSubstr("each 1.50 M cycles, 3.00 MB, "));
}

TEST(Summary, SharesOfTheSlotsAreOfAllOfThem) {
    const Measures m = measures_of(two_frames());
    EXPECT_EQ(m[slot_measure(Slot::Useful)], 0.75);
    EXPECT_EQ(m[slot_measure(Slot::Blocked)], 0.25);
}

} // namespace
} // namespace degs::sim
