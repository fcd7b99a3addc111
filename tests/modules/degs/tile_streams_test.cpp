// SPDX-License-Identifier: Apache-2.0
// Several tiles in the array at once, against dates worked out by hand.
#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::blanket;
using test::DegsRun;
using test::exact_arithmetic;
using test::make_frame;
using test::one_row;

constexpr std::uint64_t kSplats = 20;

/// Two tiles of 16 x 16 px, each with twenty splats that cover row 5: one conflict domain per tile,
/// so that a tile keeps the array busy in every fourth cycle. One bank of 16 PEs: a row is a
/// packet.
FrameWorkload two_chains() {
    std::vector<ProjectedSplat> splats;
    for (std::uint64_t i = 0; i < kSplats; ++i) {
        splats.push_back(one_row(0, 15, 5, 0.1));
        splats.push_back(one_row(16, 31, 5, 0.1));
    }
    return make_frame(splats, 32, 16, 16);
}

DegsConfig one_bank(int streams) {
    DegsConfig config = exact_arithmetic();
    config.tile_size = 16;
    config.slicing.count = streams;
    config.slicing.interleave = streams;
    config.span.count = 1;
    config.scheduler.banks = 1;
    config.array.pes_per_bank = 16;
    config.pixel_buffer.bytes = streams * config.pixel_buffer.state_bytes * 16 * 16;
    config.memory.latency_ns = 0;
    config.memory.bandwidth_gb_per_s = 1e5;
    return config;
}

constexpr Cycle chain(std::uint64_t splats) {
    return 4 * (splats - 1) + 1;
}

// A single stream with one context: the second chain starts when the first one has ended, been
// written back and read out.
TEST(TileStreams, OneStreamWorksOnOneTileAfterTheOther) {
    const FrameWorkload frame = two_chains();
    const DegsRun run("run", one_bank(1), {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    test::expect_reference(run);
    EXPECT_EQ(run.packets(), 2 * kSplats);
    const Cycle readout = 16 / 2; // two rows per cycle, which take longer than 64 pixels per cycle
    const Cycle handover = 1 + 4 + readout + 1 + 2; // end, write-back, context, packing
    EXPECT_EQ(run.window().cycles(), 2 * chain(kSplats) + handover - 1);
}

// Two streams: the chains run side by side. The lists are granted one cycle after the other, and
// the second chain executes in the gaps of the first.
TEST(TileStreams, TwoStreamsFillEachOthersGaps) {
    const FrameWorkload frame = two_chains();
    const DegsRun run("run", one_bank(2), {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    test::expect_reference(run);
    EXPECT_EQ(run.packets(), 2 * kSplats);
    EXPECT_EQ(run.window().cycles(), chain(kSplats) + 1);
    EXPECT_EQ(run.slots()[Slot::Useful], 2 * kSplats * 16);
}

// Two clusters of one stream: each chain has an array of its own. The lists are granted
// one cycle after the other.
TEST(TileStreams, TwoClustersWorkOnATileEach) {
    const FrameWorkload frame = two_chains();
    DegsConfig config = one_bank(1);
    config.clusters = 2;
    const DegsRun run("run", config, {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    test::expect_reference(run);
    EXPECT_EQ(run.packets(), 2 * kSplats);
    EXPECT_EQ(run.window().cycles(), chain(kSplats) + 1);
    for (const auto& slice : run.degs().slices()) {
        EXPECT_EQ(slice->stats().packets, kSplats);
        EXPECT_EQ(slice->stats().window.cycles(), chain(kSplats));
    }
    EXPECT_EQ(run.slots().total(), 2 * 16 * run.window().cycles());
}

} // namespace
} // namespace degs
