// SPDX-License-Identifier: Apache-2.0
// The worked example of docs/adding-an-accelerator.md keeps every promise that an accelerator of
// this project has to keep.
#include "tests/baselines/row_sweep.hpp"

#include "config/config_source.hpp"
#include "splat/images/image_metrics.hpp"
#include "tests/baselines/engine_run.hpp"

namespace degs {
namespace {

using example::RowSweepConfig;
using test::EngineRun;

class RowSweep : public ::testing::TestWithParam<int> {};

TEST_P(RowSweep, PaintsTheReferenceAndStrictAgrees) {
    const FrameWorkload frame = test::random_frame(7, 70, 50, GetParam(), 200);
    RowSweepConfig config;
    config.tile_size = GetParam();
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
INSTANTIATE_TEST_SUITE_P(Tiles, RowSweep, ::testing::Values(8, 16, 32));

// A splat over the whole tile takes a slot for each of its 16 rows, one of a single pixel takes
// one; all 16 lanes are busy in each.
TEST(RowSweepSlots, TakesARowPerCycle) {
    const FrameWorkload frame =
        test::make_frame({test::blanket(8, 8, 16), test::one_pixel(3, 3)}, 16, 16, 16);
    const EngineRun run("run", RowSweepConfig{}, {&frame}, Fidelity::Exact, {true});
    sc_core::sc_start();
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.window.cycles(), 16U + 1U);
    EXPECT_EQ(result.slots[Slot::Useful], 256U + 1U);
    EXPECT_EQ(result.slots[Slot::Boundary], 15U);
}

TEST(RowSweepConfiguration, IsConfiguredLikeAnyOther) {
    RowSweepConfig config;
    ConfigSource::from_overrides({"tile_size=32", "memory.latency_ns=7"}).load(config);
    EXPECT_EQ(config.pes(), 32);
    EXPECT_THROW(ConfigSource::from_overrides({"tile_sise=32"}).load(config), InputError);
}

} // namespace
} // namespace degs
