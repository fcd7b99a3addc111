// SPDX-License-Identifier: Apache-2.0
// The worked example of docs/adding-an-accelerator.md keeps every promise that an accelerator of
// this project has to keep.
#include "config.hpp"

#include "config/config_source.hpp"
#include "splat/images/image_metrics.hpp"
#include "tests/baselines/engine_run.hpp"

namespace degs {
namespace {

using row_sweep::Config;
using test::EngineRun;

Config design(const std::vector<std::string>& settings) {
    Config config;
    ConfigSource::from_overrides(settings).load(config);
    return config;
}

/// Side of a tile, arrays, and whether rows that have ended take no slot.
using Size = std::tuple<int, int, bool>;

class RowSweep : public ::testing::TestWithParam<Size> {};

TEST_P(RowSweep, PaintsTheReferenceAndStrictAgrees) {
    const auto [side, arrays, skips] = GetParam();
    const FrameWorkload frame = test::random_frame(7, 70, 50, side, 200);
    const Config config =
        design({"tile_size=" + std::to_string(side), "arrays.count=" + std::to_string(arrays),
                "pixel_buffer.bytes=32768", skips ? "arrays.skip_ended=true" : "name=x"});
    const EngineRun exact("exact", config, {&frame});
    const EngineRun strict("strict", config, {&frame}, Fidelity::Strict);
    const EngineRun alone("alone", config, {&frame}, Fidelity::Exact, {true});
    sc_core::sc_start();
    exact.expect_sound();
    alone.expect_sound();
    EXPECT_EQ(exact.words(), strict.words());
    EXPECT_EQ(alone.result().slots[Slot::Useful], exact.result().slots[Slot::Useful]);
    ReferenceCounts counts;
    const Image reference = render_reference(frame, counts);
    EXPECT_GT(compare_images(reference, exact.image()).psnr_db, 100);
}
INSTANTIATE_TEST_SUITE_P(Sizes, RowSweep,
                         ::testing::Values(Size{8, 1, false}, Size{16, 4, false}, Size{16, 3, true},
                                           Size{32, 2, true}));

// What maps and timelines show of the tiles adds up to the slots of the run.
TEST(RowSweepSlots, AreThoseOfTheTiles) {
    const FrameWorkload frame = test::random_frame(7, 70, 50, 16, 200);
    const Config config = design({"arrays.count=3", "pixel_buffer.readout_pixels=1"});
    const Timebase time{ClockDomain(config.clock_ghz)};
    RenderJob job = make_render_job({&frame}, config);
    job.recorder = std::make_unique<SlotRecorder>(nullptr);
    const auto engine = config.build("run", time, job, {});
    sc_core::sc_start();
    job.recorder->close();
    AcceleratorResult result;
    engine->collect(result);
    SlotAccount sum;
    for (const TileActivity& tile : job.recorder->tiles()) {
        sum += tile.slots;
    }
    for (const SlotClass& each : kSlotClasses) {
        EXPECT_EQ(sum[each.slot], result.slots[each.slot]) << each.name;
    }
    EXPECT_GT(sum[Slot::Blocked], 0U);
}

// A splat over the whole tile takes a slot for each of its 16 rows, one of a single pixel takes
// one; all 16 PEs are busy in each.
TEST(RowSweepSlots, TakesARowPerCycle) {
    const FrameWorkload frame =
        test::make_frame({test::blanket(8, 8, 16), test::one_pixel(3, 3)}, 16, 16, 16);
    const EngineRun run("run", design({"arrays.count=1"}), {&frame}, Fidelity::Exact, {true});
    sc_core::sc_start();
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.window.cycles(), 16U + 1U);
    EXPECT_EQ(result.slots[Slot::Useful], 256U + 1U);
    EXPECT_EQ(result.slots[Slot::Boundary], 15U);
}

TEST(RowSweepConfiguration, IsConfiguredLikeAnyOther) {
    const Config config = design({"tile_size=32", "pixel_buffer.bytes=16384"});
    EXPECT_EQ(config.pes(), 4 * 32);
    EXPECT_THROW(design({"tile_sise=32"}), InputError);
    EXPECT_THROW(design({"tile_size=32"}), InputError) << "no tile fits";
}

} // namespace
} // namespace degs
