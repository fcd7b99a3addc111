// SPDX-License-Identifier: Apache-2.0
// GSCore as a whole: random configurations on random frames, and what its front end saves.
#include "baselines/gscore/engine.hpp"

#include "tests/baselines/engine_run.hpp"

namespace degs {
namespace {

using test::blanket;
using test::EngineRun;
using test::make_frame;

/// Random configurations whose sizes fit together.
class RandomGscore {
public:
    explicit RandomGscore(unsigned seed) : random_(seed) {}
    int upto(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n + 1)); }
    int among(std::initializer_list<int> values) {
        return values.begin()[upto(static_cast<int>(values.size()) - 1)];
    }
    gscore::Config config(unsigned index) {
        for (;;) {
            const gscore::Config c = candidate(index);
            if (c.problem().empty()) {
                return c;
            }
        }
    }

private:
    gscore::Config candidate(unsigned index) {
        gscore::Config c;
        const Arithmetic odd[] = {Arithmetic::Fp32, Arithmetic::Paper, Arithmetic::Tuned};
        c.pipeline.numbers = index % 2 == 0 ? Arithmetic::Fp64 : odd[index / 2 % 3];
        c.pipeline.stop_rule = index % 8 == 1 ? StopRule::After : StopRule::Refuse;
        c.array.lanes = among({64, 64, 16, 256});
        c.array.subtile_skip = static_cast<SubtileTest>(among({0, 0, 1, 2}));
        c.array.clusters = among({1, 1, 2, 4});
        c.array.termination_cycles = among({1, 1, 3, 40});
        c.array.pipeline_cycles = among({4, 1, 192});
        const int tile = c.tile_size_px();
        c.pixel_buffer.bytes = 16 * tile * tile * among({2, 2, 1, 3});
        c.pixel_buffer.readout_pixels = among({64, 1, 1024});
        c.pixel_buffer.writes_in_flight = among({4, 1});
        c.buffer.bytes = c.pixel_buffer.bytes + among({264, 64, 8}) * 1024;
        c.sorting.count = among({4, 1, 2, 3});
        c.sorting.chunk = among({256, 2, 16, 50});
        c.sorting.keys_per_cycle = among({2, 1, 8});
        c.sorting.fine_cycles_per_key = among({2, 1, 5});
        c.fetching.chunk = among({16, 1, 5});
        c.fetching.chunks_in_flight = among({8, 1, 2});
        c.monitor.cancel = upto(3) != 0;
        c.monitor.latency_cycles = among({8, 1, 50});
        c.traffic.sh = static_cast<ShReads>(upto(1));
        c.clusters = among({1, 1, 2, 3, 8});
        c.frames_in_flight = among({2, 1});
        c.tile_order = static_cast<TileOrder>(among({0, 1}));
        const double bandwidth[] = {204.8, 51.2, 1.0, 1e5};
        c.memory.bandwidth_gb_per_s = bandwidth[upto(3)];
        const double latency[] = {100, 0, 3.3, 1000};
        c.memory.latency_ns = latency[upto(3)];
        return c;
    }
    std::mt19937 random_;
};

class SmallRunGscore : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunGscore, ExactIsStrict) {
    const unsigned index = GetParam();
    RandomGscore draw(index);
    const gscore::Config config = draw.config(index);
    std::vector<FrameWorkload> frames;
    for (int f = index % 4 == 3 ? 3 : 1; f > 0; --f) {
        frames.push_back(test::random_frame(index * 10 + static_cast<unsigned>(f),
                                            1 + draw.upto(120), 1 + draw.upto(90),
                                            config.tile_size_px(), draw.among({1, 60, 300, 700})));
    }
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    BuildOptions options;
    options.array_only = index % 5 == 4;
    const EngineRun exact("exact", config, list, Fidelity::Exact, options);
    const EngineRun strict("strict", config, list, Fidelity::Strict, options);
    sc_core::sc_start();
    exact.expect_sound();
    EXPECT_EQ(exact.words(), strict.words());
    for (std::size_t f = 0; f < frames.size(); ++f) {
        EXPECT_TRUE(test::same_bytes(exact.image(f), strict.image(f)));
    }
    if (index % 2 == 0) {
        exact.expect_reference();
    }
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunGscore, ::testing::Range(0U, 60U));

std::uint64_t count_of(const AcceleratorResult& result, const std::string& stage,
                       const std::string& name) {
    for (const StageUse& use : result.stages) {
        for (const Counters::Counter& counter : use.counters) {
            if (use.name == stage && counter.doc.name == name) {
                return counter.value;
            }
        }
    }
    ADD_FAILURE() << stage << '.' << name << " is not in the result";
    return 0;
}

// Four tiles under 2000 opaque splats that end after three: the first chunk of each is sorted, and
// what is sorted or fetched before the cancellation comes back; the bulk is neither.
TEST(Gscore, FinishedTilesAreNeitherSortedNorFetched) {
    const FrameWorkload frame =
        make_frame(std::vector<ProjectedSplat>(2000, blanket(16, 16, 1e4, 0.98)), 32, 32, 16);
    gscore::Config config;
    config.buffer.bytes = config.pixel_buffer.bytes + 128 * 1024;
    const EngineRun run("run", config, {&frame});
    config.monitor.cancel = false;
    const EngineRun all("all", config, {&frame});
    sc_core::sc_start();
    run.expect_sound();
    all.expect_sound();
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.tiles_cancelled, 4U);
    // One chunk of 8 is rendered, and the sorter is one or two ahead.
    EXPECT_GE(count_of(result, "sorting", "keys_sorted"), 4U * 256);
    EXPECT_LE(count_of(result, "sorting", "keys_sorted"), 4U * 3 * 256);
    EXPECT_LE(count_of(result, "fetching", "records"), 4U * 2 * 256);
    EXPECT_EQ(count_of(result, "blending", "splats"), 4U * 3);
    EXPECT_EQ(count_of(all.result(), "sorting", "keys_sorted"), 4U * 2000);
    EXPECT_EQ(count_of(all.result(), "fetching", "records"), 4U * 2000);
    EXPECT_EQ(all.result().slots[Slot::Useful], result.slots[Slot::Useful]);
}

std::uint64_t bytes_read(const AcceleratorResult& result, const std::string& stream) {
    std::uint64_t bytes = 0;
    for (const StreamUse& use : result.streams) {
        bytes += use.name == stream ? use.bytes_read : 0;
    }
    return bytes;
}

// 59 values of fp32 per Gaussian, whether it is visible or not.
TEST(Gscore, ReadsTheShOfCulledGaussians) {
    FrameWorkload frame = make_frame({blanket(8, 8, 4)}, 16, 16, 16);
    frame.gaussians = 64 * 10;
    frame.sh_degree = 3;
    gscore::Config visible;
    visible.pipeline.records = Records::Fp32;
    visible.traffic.set_formats(visible.pipeline.stored_numbers());
    gscore::Config all = visible;
    all.traffic.sh = ShReads::All;
    const EngineRun run("run", all, {&frame});
    const EngineRun frugal("frugal", visible, {&frame});
    sc_core::sc_start();
    EXPECT_EQ(bytes_read(run.result(), "sh"), 640U * 48 * 4);
    EXPECT_EQ(bytes_read(run.result(), "geometry"), 640U * 11 * 4);
    EXPECT_EQ(bytes_read(frugal.result(), "sh"), 192U);
}

// The array alone has its lists at once: no wait but for contexts.
TEST(Gscore, ArrayOnlyNeverStarves) {
    const FrameWorkload frame = test::random_frame(7, 120, 80, 16, 600);
    BuildOptions options;
    options.array_only = true;
    const EngineRun run("run", gscore::Config{}, {&frame}, Fidelity::Exact, options);
    sc_core::sc_start();
    run.expect_sound();
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.slots[Slot::Starved], 0U);
    EXPECT_LT(result.cycles, result.window.cycles() + 40);
}

// The kernel goes on for longer than the frame, and not as long in both fidelities.
TEST(SmallRunGscore, MemoryEnergyEndsWithTheRun) {
    const FrameWorkload frame = test::random_frame(9, 64, 17, 16, 1500);
    gscore::Config config;
    config.sorting.fine_cycles_per_key = 1024;
    config.memory.model = MemoryModel::Lpddr5;
    const EngineRun exact("exact", config, {&frame}, Fidelity::Exact);
    const EngineRun strict("strict", config, {&frame}, Fidelity::Strict);
    sc_core::sc_start(sc_core::sc_time(20, sc_core::SC_MS));
    exact.expect_sound();
    EXPECT_EQ(exact.words(), strict.words());
    const AcceleratorResult result = exact.result();
    // Channels that do nothing but refresh: 22 to 30 mW each (docs/lpddr5.md).
    const auto us = static_cast<double>(result.cycles) * 1e-3;
    const auto channels = static_cast<double>(config.memory.lpddr5.channels);
    EXPECT_GE(result.dram_energy->background_nj, 22 * channels * us);
    EXPECT_LE(result.dram_energy->background_nj, 30.1 * channels * us);
}

// Fewer useless slots the finer the test, at the same image.
TEST(ShapeGscore, FinerSubtileTestsTakeFewerPasses) {
    const FrameWorkload frame = test::random_frame(8, 120, 80, 16, 600);
    std::vector<std::unique_ptr<EngineRun>> runs;
    for (const SubtileTest skip : {SubtileTest::None, SubtileTest::Obb, SubtileTest::Exact}) {
        gscore::Config config;
        config.array.subtile_skip = skip;
        runs.push_back(std::make_unique<EngineRun>("run" + std::to_string(runs.size()), config,
                                                   std::vector<const FrameWorkload*>{&frame}));
    }
    sc_core::sc_start();
    for (std::size_t i = 1; i < runs.size(); ++i) {
        EXPECT_LT(count_of(runs[i]->result(), "blending", "passes"),
                  count_of(runs[i - 1]->result(), "blending", "passes"));
        EXPECT_EQ(runs[i]->result().slots[Slot::Useful], runs[0]->result().slots[Slot::Useful]);
        EXPECT_TRUE(test::same_bytes(runs[i]->image(), runs[0]->image()));
    }
}

// What a pixel takes does not depend on which array works on its tile, nor on how many there are.
TEST(GscoreClusters, ChangeNoPixelAndTakeTheTilesInTurn) {
    const FrameWorkload frame = test::random_frame(11, 150, 120, 16, 400);
    gscore::Config config;
    config.pipeline.numbers = Arithmetic::Fp64;
    std::vector<std::unique_ptr<EngineRun>> runs;
    const int counts[] = {1, 2, 4, 64};
    for (const int clusters : counts) {
        config.clusters = clusters;
        runs.push_back(std::make_unique<EngineRun>("k" + std::to_string(clusters), config,
                                                   std::vector<const FrameWorkload*>{&frame}));
    }
    sc_core::sc_start();
    for (const auto& run : runs) {
        run->expect_sound();
        run->expect_reference();
        EXPECT_TRUE(test::same_bytes(run->image(), runs.front()->image()));
        EXPECT_EQ(run->result().slots.executed(), runs.front()->result().slots.executed());
    }
    EXPECT_LT(runs[1]->result().cycles, runs[0]->result().cycles);
    EXPECT_LT(runs[2]->result().cycles, runs[1]->result().cycles);
}

// Each of two arrays has two of four tiles of 4 sub-tiles under 60 splats. Chunks are there at
// once, so that the second starts a cycle after the first, because one tile is granted per cycle.
TEST(GscoreClusters, ShareTheWorkOfTheArrayAlone) {
    const FrameWorkload frame =
        make_frame(std::vector<ProjectedSplat>(60, blanket(32, 8, 1e4, 0.01)), 64, 16, 16);
    gscore::Config config;
    config.pixel_buffer.bytes = 4 * config.pixel_buffer.state_bytes * 16 * 16;
    BuildOptions alone;
    alone.array_only = true;
    const EngineRun one("one", config, {&frame}, Fidelity::Exact, alone);
    config.clusters = 2;
    const EngineRun two("two", config, {&frame}, Fidelity::Exact, alone);
    sc_core::sc_start();
    one.expect_sound();
    two.expect_sound();
    EXPECT_EQ(one.result().window.cycles(), 4U * 4 * 60);
    EXPECT_EQ(two.result().window.cycles(), 2U * 4 * 60 + 1);
    const SlotAccount& slots = two.result().slots;
    EXPECT_EQ(slots[Slot::Starved], 64U);
    EXPECT_EQ(slots[Slot::Drain], 64U);
    EXPECT_EQ(slots[Slot::Useful], one.result().slots[Slot::Useful]);
}

// Tiles that end after three splats: their lists are sorted to the end, their records are not
// fetched, and what has been fetched in vain does not reach the next tile.
TEST(GscoreClusters, StopTheirTilesEarly) {
    const FrameWorkload frame =
        make_frame(std::vector<ProjectedSplat>(2000, blanket(32, 8, 1e4, 0.98)), 64, 16, 16);
    gscore::Config config;
    config.pipeline.numbers = Arithmetic::Fp64;
    config.clusters = 2;
    const EngineRun run("run", config, {&frame});
    sc_core::sc_start();
    run.expect_sound();
    run.expect_reference();
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.tiles_cancelled, 4U);
    EXPECT_EQ(count_of(result, "sorting", "keys_sorted"), 4U * 2000);
    EXPECT_LT(count_of(result, "fetching", "records"), 4U * 1000);
    EXPECT_EQ(count_of(result, "blending", "splats"), 4U * 3);
    EXPECT_EQ(count_of(result, "dispatch", "tiles"), 4U);
}

// Projection and sorting are shared; lanes and memories are there once per cluster.
TEST(GscoreClusters, CostLanesAndMemoriesOfTheirOwn) {
    gscore::Config config;
    const cost::BillOfMaterials one = config.bill();
    config.clusters = 3;
    EXPECT_EQ(config.problem(), "");
    EXPECT_EQ(config.pes(), 3 * 64);
    EXPECT_EQ(config.tile_contexts(), 6);
    EXPECT_EQ(config.splat_chunks(), 4 * gscore::Config().splat_chunks());
    EXPECT_EQ(config.sort_capacity(), 3 * gscore::Config().sort_capacity());
    const cost::BillOfMaterials three = config.bill();
    ASSERT_EQ(three.blocks().size(), one.blocks().size());
    for (std::size_t b = 0; b < one.blocks().size(); ++b) {
        const cost::Block& block = one.blocks()[b];
        const bool shared = block.name == "projection" || block.name == "sorting";
        EXPECT_NEAR(three.blocks()[b].area_mm2, block.area_mm2 * (shared ? 1 : 3), 1e-9)
            << block.name;
    }
}

} // namespace
} // namespace degs
