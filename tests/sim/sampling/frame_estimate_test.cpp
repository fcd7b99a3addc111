// SPDX-License-Identifier: Apache-2.0
// Intervals of a frame from a sample of equal blocks, for which survey sampling has closed forms.
#include "sim/design/run_config.hpp"
#include "sim/sampling/frame_estimate.hpp"
#include "sim/sampling/sampled_run.hpp"
#include "sim/view/view.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace degs::sim {
namespace {

constexpr std::size_t kBlocks = 40;
constexpr double kCyclesOfABlock = 10;

/// Four of forty equal blocks, each a group, which read 100, 140, 120 and 80 B.
struct FourBlocks {
    RunConfig config = default_run_config("degs", {"clock_ghz=2"});
    std::vector<TileWork> blocks{kBlocks, TileWork{1, 16, 5, 5, 4, 8, 8, 9}};
    FrameEstimate estimate{config.accelerator(), FrameWorkload(), blocks};

    FourBlocks() {
        const auto pes = static_cast<std::uint64_t>(config.accelerator().pes());
        AcceleratorResult run;
        run.pes = config.accelerator().pes();
        run.clock_ghz = 2;
        run.frames.resize(1);
        run.streams.resize(1);
        const cost::BillOfMaterials bill = config.accelerator().bill();
        for (const cost::Block& block : bill.blocks()) {
            run.activity.push_back({block.name, 0});
        }
        estimate.begin(run);
        std::size_t group = 0;
        for (const std::uint64_t bytes : {100, 140, 120, 80}) {
            const AcceleratorResult before = run;
            run.streams[0].bytes_read += bytes;
            run.window.include(run.cycles);
            run.cycles += static_cast<Cycle>(kCyclesOfABlock);
            run.memory_window = run.cycles;
            run.window.include(run.cycles - 1);
            WindowPart part;
            part.slots[Slot::Useful] = part.total = pes * static_cast<Cycle>(kCyclesOfABlock);
            estimate.add_block(7 * group, group, part);
            estimate.add_group(before, run, blocks.front());
            ++group;
        }
    }
};

// The mean of n of N values, drawn without replacement, has the variance (1 - n/N) s2 / n.
TEST(FrameEstimate, IntervalsOfCountersAreThoseOfAMeanOfGroups) {
    const double mean = 110, s2 = (100 + 900 + 100 + 900) / 3.0; // of 100, 140, 120, 80
    const double error = std::sqrt((1 - 4.0 / kBlocks) * s2 / 4);
    EXPECT_NEAR(FourBlocks().estimate.relative_half_width("dram.bytes_read"),
                student_t(3) * error / mean, 1e-3);
}

// Blocks that take equally long leave the 0.3 % of docs/sampling.md for the state of the pipeline.
TEST(FrameEstimate, IntervalsOfTheTimeHaveThatOfThePipeline) {
    const FourBlocks four;
    EXPECT_NEAR(four.estimate.relative_half_width("timing.cycles"), 0.003, 1e-6);
    const double ms = kBlocks * kCyclesOfABlock / 2 * 1e-6; // at 2 GHz
    bool found = false;
    for (const ReportInterval& interval : four.estimate.intervals()) {
        if (interval.path == "timing.latency_ms") {
            found = true;
            EXPECT_NEAR(interval.low, ms * 0.997, 1e-9);
            EXPECT_NEAR(interval.high, ms * 1.003, 1e-9);
        }
    }
    EXPECT_TRUE(found);
}

} // namespace
} // namespace degs::sim
