// SPDX-License-Identifier: Apache-2.0
// That a tile is background is known when all Gaussians of its frame have been read: no frame ends
// before, whatever the accelerator.
#include "baselines/gbu/config.hpp"
#include "baselines/gcc/config.hpp"
#include "baselines/gscore/config.hpp"
#include "modules/degs/config.hpp"
#include "tests/baselines/engine_run.hpp"

namespace degs {
namespace {

using test::EngineRun;

/// Two frames that show nothing, of a scene that takes longer to read than their images to write.
void expect_scene_read_first(const AcceleratorConfig& config) {
    FrameWorkload frame = test::make_frame({}, 40, 30, config.tile_size_px());
    frame.gaussians = 20000;
    const std::vector<const FrameWorkload*> frames{&frame, &frame};
    const EngineRun exact("exact", config, frames, Fidelity::Exact);
    const EngineRun strict("strict", config, frames, Fidelity::Strict);
    sc_core::sc_start();
    exact.expect_sound();
    EXPECT_EQ(exact.words(), strict.words());
    const AcceleratorResult result = exact.result();
    ASSERT_EQ(result.frames.size(), 2U);
    for (const FrameDates& dates : result.frames) {
        EXPECT_GT(dates.preprocessed, 20000U / 8);
        EXPECT_GT(dates.finished, dates.preprocessed);
    }
    EXPECT_EQ(result.background_tiles, 2U * static_cast<std::uint64_t>(frame.tiles()));
    EXPECT_LE(result.memory_utilization, 1.0);
    for (const StageUse& stage : result.stages) {
        EXPECT_LE(stage.busy_cycles,
                  static_cast<double>(stage.units) * static_cast<double>(result.cycles))
            << stage.name;
    }
}

TEST(SmallRunBackground, OfDegsWaitsForTheScene) {
    expect_scene_read_first(DegsConfig());
}
TEST(SmallRunBackground, OfGscoreWaitsForTheScene) {
    expect_scene_read_first(gscore::Config());
}
TEST(SmallRunBackground, OfGbuWaitsForTheScene) {
    expect_scene_read_first(gbu::Config());
}
TEST(SmallRunBackground, OfGccWaitsForTheScene) {
    expect_scene_read_first(gcc::Config());
}

} // namespace
} // namespace degs
