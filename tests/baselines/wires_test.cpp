// SPDX-License-Identifier: Apache-2.0
// Messages never push back: many more tiles end than any ring of messages could hold, long after
// those who are told have handed on all their work.
#include "baselines/accelerators.hpp"
#include "baselines/gbu/config.hpp"
#include "baselines/gcc/config.hpp"
#include "baselines/gscore/config.hpp"
#include "modules/degs/config.hpp"
#include "tests/baselines/engine_run.hpp"

namespace degs {
namespace {

using test::blanket;
using test::EngineRun;
using test::make_frame;

/// Four opaque splats over `side` x `side` tiles of 16 px; three of them end every pixel.
FrameWorkload wall(int side) {
    const double centre = 8.0 * side;
    return make_frame(std::vector<ProjectedSplat>(4, blanket(centre, centre, 1e5, 0.98)), 16 * side,
                      16 * side, 16);
}

void expect_all_tiles_cancelled(const AcceleratorConfig& config, const FrameWorkload& frame) {
    const EngineRun exact("exact", config, {&frame}, Fidelity::Exact);
    const EngineRun strict("strict", config, {&frame}, Fidelity::Strict);
    sc_core::sc_start();
    exact.expect_sound();
    strict.expect_sound();
    EXPECT_EQ(exact.words(), strict.words());
    EXPECT_EQ(exact.result().tiles_cancelled, static_cast<std::uint64_t>(frame.tiles()));
}

// The buffer in front of the array holds the chunks of all tiles, so that fetchers and sorters are
// done before the first tile is.
TEST(SmallRunWires, GscoreEndsManyTilesAheadOfTheArray) {
    gscore::Config config;
    config.array.lanes = 16;
    config.buffer.bytes = 4 * 1024 * 1024;
    expect_all_tiles_cancelled(config, wall(14));
}

TEST(SmallRunWires, DegsEndsManyTilesAheadOfTheArray) {
    DegsConfig config;
    config.tile_size = 16;
    config.gaussian_buffer.bytes = 4 * 1024 * 1024;
    expect_all_tiles_cancelled(config, wall(14));
}

// Regions are reported long before the Slicing Units hear of them: 14 x 14 tiles of 16 rows each.
TEST(SmallRunWires, DegsEndsRegionsLongBeforeTheyAreSeen) {
    DegsConfig config;
    config.tile_size = 16;
    config.pixel_buffer.bytes = 16 * config.pixel_buffer.bytes;
    config.slicing.skip_dead_rows = true;
    config.slicing.feedback_cycles = 4000;
    expect_all_tiles_cancelled(config, wall(14));
}

TEST(SmallRunWires, GbuEndsManyTilesAheadOfTheEngines) {
    gbu::Config config;
    config.tile_size = 16;
    config.engines.row_pes = 16;
    config.list_buffer.chunks = 256;
    config.monitor.latency_cycles = 4000;
    expect_all_tiles_cancelled(config, wall(14));
}

TEST(SmallRunWires, GccEndsManyViewsAheadOfTheArray) {
    gcc::Config config;
    config.view_size = 16;
    config.colour.block = 4;
    config.colour.feedback_cycles = 4000;
    config.monitor.latency_cycles = 4000;
    config.projection.group = 4;
    config.projection.groups_ahead = 64;
    config.image_buffer.bytes = 1024 * 1024;
    expect_all_tiles_cancelled(config, wall(14));
}

} // namespace
} // namespace degs
