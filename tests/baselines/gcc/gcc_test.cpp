// SPDX-License-Identifier: Apache-2.0
// GCC as a whole: random configurations on random frames, and what its stages save.
#include "tests/baselines/gcc/gcc_run.hpp"

namespace degs {
namespace {

using test::blanket;
using test::gcc_of;
using test::GccRun;
using test::make_frame;
using test::one_pixel;

/// Random configurations whose sizes fit together.
class RandomGcc {
public:
    explicit RandomGcc(unsigned seed) : random_(seed) {}
    int upto(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n + 1)); }
    int among(std::initializer_list<int> values) {
        return values.begin()[upto(static_cast<int>(values.size()) - 1)];
    }
    gcc::Config config(unsigned index) {
        for (;;) {
            const gcc::Config c = candidate(index);
            if (c.problem().empty()) {
                return c;
            }
        }
    }

private:
    gcc::Config candidate(unsigned index) {
        gcc::Config c = gcc_of(among({32, 64, 128, 24}), among({8, 8, 4, 16, 5}));
        const Arithmetic odd[] = {Arithmetic::Fp32, Arithmetic::Paper, Arithmetic::Tuned};
        c.pipeline.numbers = index % 2 == 0 ? Arithmetic::Fp64 : odd[index / 2 % 3];
        c.pipeline.stop_rule = index % 8 == 1 ? StopRule::After : StopRule::Refuse;
        c.image_buffer.bytes *= among({1, 1, 2, 3});
        c.image_buffer.readout_pixels = among({64, 1, 1024});
        c.image_buffer.writes_in_flight = among({4, 1});
        c.array.skip_cycles = among({0, 0, 1, 3});
        c.array.discovery_cycles = among({1, 1, 4, 8});
        c.array.writeback_cycles = among({4, 1, 20});
        c.grouping.means_per_cycle = among({4, 1});
        c.grouping.chunk = among({256, 16, 1});
        c.grouping.chunks_in_flight = among({4, 1});
        c.grouping.entries_per_cycle = among({8, 1});
        c.grouping.writes_in_flight = among({8, 1});
        c.grouping.lists = static_cast<gcc::Lists>(upto(1));
        c.projection.units = among({4, 1});
        c.projection.group = among({256, 16, 1, 50});
        c.projection.groups_ahead = among({1, 1, 2});
        c.projection.latency_cycles = among({32, 1});
        c.colour.units = among({4, 1});
        c.colour.keys_per_cycle = among({4, 1});
        c.colour.merge_ways = among({16, 2});
        c.colour.skip_ended = upto(3) != 0;
        c.colour.block = among({8, 8, 4, 16, 7});
        c.colour.feedback_cycles = among({8, 1, 100});
        c.colour.chunk = among({16, 1, 100});
        c.monitor.cancel = upto(3) != 0;
        c.clusters = among({1, 1, 2, 3, 7});
        c.monitor.latency_cycles = among({8, 1, 50});
        c.frames_in_flight = among({2, 1});
        c.tile_order = static_cast<TileOrder>(among({0, 1}));
        const double bandwidth[] = {204.8, 204.8, 51.2, 1.0, 1e5};
        c.memory.bandwidth_gb_per_s = bandwidth[upto(4)];
        const double latency[] = {100, 100, 0, 3.3, 1000};
        c.memory.latency_ns = latency[upto(4)];
        return c;
    }
    std::mt19937 random_;
};

class SmallRunGcc : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunGcc, ExactIsStrict) {
    const unsigned index = GetParam();
    RandomGcc draw(index);
    const gcc::Config config = draw.config(index);
    std::vector<FrameWorkload> frames;
    for (int f = index % 4 == 3 ? 3 : 1; f > 0; --f) {
        frames.push_back(test::random_frame(index * 10 + static_cast<unsigned>(f),
                                            1 + draw.upto(150), 1 + draw.upto(110),
                                            config.view_size, draw.among({1, 60, 300, 900})));
    }
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    const BuildOptions options{index % 5 == 4};
    const GccRun exact("exact", config, list, Fidelity::Exact, options);
    const GccRun strict("strict", config, list, Fidelity::Strict, options);
    sc_core::sc_start();
    test::expect_sound(exact);
    test::expect_same(exact, strict);
    if (config.pipeline.numbers.base == Arithmetic::Fp64 &&
        config.pipeline.stop_rule == StopRule::Refuse) {
        test::expect_reference(exact);
    }
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunGcc, ::testing::Range(0U, 60U));

/// Ends the left half of every view row by row: opaque splats on each of its pixels, then `behind`
/// small ones there, which reach nothing live, and one on the right.
FrameWorkload half_ended(int behind) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 3 * 16 * 32; ++i) {
        splats.push_back(one_pixel(i / 3 % 16, i / 48, 1.0));
    }
    for (int i = 0; i < behind; ++i) {
        splats.push_back(one_pixel(2 + i % 8, 2 + i / 8 % 20, 0.5));
    }
    splats.push_back(one_pixel(24, 24, 0.5));
    return make_frame(splats, 32, 32, 32);
}

// Cross-stage conditional processing: what reaches ended blocks only is projected, but its SH is
// not read and it takes no slot.
TEST(SmallRunGccStages, TheMaskSavesSphericalHarmonics) {
    const FrameWorkload frame = half_ended(2000);
    gcc::Config config = gcc_of(32);
    const GccRun masked("masked", config, {&frame});
    config.colour.skip_ended = false;
    const GccRun plain("plain", config, {&frame});
    sc_core::sc_start();
    test::expect_sound(masked);
    test::expect_reference(masked);
    test::expect_reference(plain);
    EXPECT_GT(masked.gcc().colour()[0]->stats().masked, 300U); // the mask is late by some groups
    EXPECT_EQ(plain.gcc().colour()[0]->stats().masked, 0U);
    EXPECT_EQ(plain.gcc().colour()[0]->stats().coloured, frame.tile_pairs());
    EXPECT_LT(masked.stream_bytes("sh"), plain.stream_bytes("sh"));
    EXPECT_EQ(masked.stream_bytes("shapes"), plain.stream_bytes("shapes"));
}

// A view that is opaque at once: remaining groups are not loaded.
TEST(SmallRunGccStages, AFinishedViewStopsItsGroups) {
    std::vector<ProjectedSplat> splats(3, blanket(16, 16, 1e4, 1.0));
    splats.resize(20'000, blanket(16, 16, 100, 0.5));
    const FrameWorkload frame = make_frame(splats, 64, 32, 32);
    gcc::Config config = gcc_of(32);
    const GccRun stopped("stopped", config, {&frame});
    config.monitor.cancel = false;
    const GccRun literal("literal", config, {&frame});
    sc_core::sc_start();
    test::expect_reference(stopped);
    test::expect_reference(literal);
    EXPECT_EQ(stopped.gcc().monitors()[0]->stats().tiles_cancelled, 2U);
    EXPECT_LT(stopped.gcc().projection()[0]->stats().entries, 2U * 20 * 256);
    EXPECT_EQ(literal.gcc().projection()[0]->stats().entries, 40'000U);
    EXPECT_LT(stopped.result().cycles, literal.result().cycles / 2);
}

// Bytes by stage: means and bounds of all, an entry written and read per overlap, one burst per
// overlap for the shape, SH of degree 3 (96 B, two bursts wherever it lies) likewise.
TEST(SmallRunGccStages, TrafficByStage) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 64; ++i) {
        splats.push_back(blanket(32, 16, 30, 0.01));
    }
    FrameWorkload frame = make_frame(splats, 64, 32, 32);
    frame.sh_degree = 3;
    gcc::Config config = gcc_of(32);
    const GccRun direct("direct", config, {&frame});
    config.grouping.lists = gcc::Lists::Regrouped;
    const GccRun regrouped("regrouped", config, {&frame});
    sc_core::sc_start();
    EXPECT_EQ(direct.stream_bytes("means"), 64U * 8);
    EXPECT_EQ(direct.stream_bytes("group_lists_written"), 128U * 8);
    EXPECT_EQ(direct.stream_bytes("group_lists_read"), 128U * 8);
    EXPECT_EQ(direct.stream_bytes("shapes"), 128U * 64);
    EXPECT_EQ(direct.stream_bytes("sh"), 128U * 128);
    // Groups of the image: 64 entries written and read before 128 are written.
    EXPECT_EQ(regrouped.stream_bytes("group_lists_written"), (64U + 64 + 128) * 8);
    EXPECT_GT(regrouped.result().frames[0].preprocessed, direct.result().frames[0].preprocessed);
}

// The array alone does what it does behind its stages, only never starved, and without memory.
TEST(SmallRunGccStages, TheArrayAlone) {
    const FrameWorkload frame = test::random_frame(8, 200, 120, 64, 500);
    const gcc::Config config = gcc_of(64);
    const GccRun whole("whole", config, {&frame});
    const GccRun alone("alone", config, {&frame}, Fidelity::Exact, {true});
    sc_core::sc_start();
    test::expect_sound(alone);
    test::expect_reference(alone);
    EXPECT_EQ(alone.result().slots[Slot::Useful], whole.result().slots[Slot::Useful]);
    EXPECT_LE(alone.result().window.cycles(), whole.result().window.cycles());
    EXPECT_EQ(alone.gcc().grouping(), nullptr);
}

// Frames overlap, at most frames_in_flight of them, and every one is right.
TEST(SmallRunGccStages, FramesOverlap) {
    const FrameWorkload first = test::random_frame(5, 100, 60, 64, 300);
    const FrameWorkload second = test::random_frame(6, 70, 90, 64, 250);
    gcc::Config config = gcc_of(64);
    const GccRun both("both", config, {&first, &second, &first});
    config.frames_in_flight = 1;
    const GccRun single("single", config, {&first, &second, &first});
    sc_core::sc_start();
    for (const GccRun* run : {&both, &single}) {
        test::expect_sound(*run);
        test::expect_reference(*run);
    }
    EXPECT_LT(both.result().cycles, single.result().cycles);
    EXPECT_GT(single.result().frames[1].preprocessed, single.result().frames[0].finished);
    EXPECT_LT(both.result().frames[1].preprocessed, both.result().frames[0].finished);
}

// What a pixel takes does not depend on the cluster that works on its view, nor on how many there
// are.
TEST(GccClusters, ChangeNoPixelAndTakeTheViewsInTurn) {
    const FrameWorkload first = test::random_frame(5, 200, 150, 32, 300);
    const FrameWorkload second = test::random_frame(6, 170, 90, 32, 250);
    gcc::Config config = gcc_of(32);
    std::vector<std::unique_ptr<GccRun>> runs;
    for (const int clusters : {1, 2, 4, 64}) {
        config.clusters = clusters;
        runs.push_back(
            std::make_unique<GccRun>("k" + std::to_string(clusters), config,
                                     std::vector<const FrameWorkload*>{&first, &second, &first}));
    }
    sc_core::sc_start();
    for (const auto& run : runs) {
        test::expect_sound(*run);
        test::expect_reference(*run);
        for (std::size_t f = 0; f < 3; ++f) {
            EXPECT_TRUE(test::same_bytes(run->image(f), runs.front()->image(f)));
        }
        EXPECT_EQ(run->result().slots.executed(), runs.front()->result().slots.executed());
    }
    EXPECT_LT(runs[1]->result().cycles, runs[0]->result().cycles);
    EXPECT_LT(runs[2]->result().cycles, runs[1]->result().cycles);
}

// Four views of 64 windows under 30 splats, of which each of two arrays has two. The lists are
// there at once, so that the second starts a cycle after the first, because one view is granted per
// cycle.
TEST(GccClusters, ShareTheWorkOfTheArrayAlone) {
    const FrameWorkload frame =
        make_frame(std::vector<ProjectedSplat>(30, blanket(128, 32, 1e4, 0.01)), 256, 64, 64);
    gcc::Config config = gcc_of(64);
    config.image_buffer.bytes *= 4;
    BuildOptions alone;
    alone.array_only = true;
    const GccRun one("one", config, {&frame}, Fidelity::Exact, alone);
    config.clusters = 2;
    const GccRun two("two", config, {&frame}, Fidelity::Exact, alone);
    sc_core::sc_start();
    test::expect_sound(one);
    test::expect_sound(two);
    EXPECT_EQ(one.result().window.cycles(), 4U * 64 * 30);
    EXPECT_EQ(two.result().window.cycles(), 2U * 64 * 30 + 1);
    const SlotAccount& slots = two.result().slots;
    EXPECT_EQ(slots[Slot::Starved], 64U);
    EXPECT_EQ(slots[Slot::Drain], 64U);
    EXPECT_EQ(slots[Slot::Useful], one.result().slots[Slot::Useful]);
}

// Stage I is shared; units and memories of the others are there once per cluster.
TEST(GccClusters, CostStagesOfTheirOwn) {
    gcc::Config config;
    const cost::BillOfMaterials one = config.bill();
    config.clusters = 3;
    EXPECT_EQ(config.problem(), "");
    EXPECT_EQ(config.pes(), 3 * 64);
    EXPECT_EQ(config.tile_contexts(), 3);
    const cost::BillOfMaterials three = config.bill();
    ASSERT_EQ(three.blocks().size(), one.blocks().size());
    for (std::size_t b = 0; b < one.blocks().size(); ++b) {
        const cost::Block& block = one.blocks()[b];
        EXPECT_NEAR(three.blocks()[b].area_mm2, block.area_mm2 * (block.name == "grouping" ? 1 : 3),
                    1e-9)
            << block.name;
    }
}

TEST(HostileConfigGcc, ProblemsNameTheirKeys) {
    const auto problem = [](void (*change)(gcc::Config&)) {
        gcc::Config config;
        change(config);
        return config.problem();
    };
    EXPECT_EQ(gcc::Config().problem(), "");
    const auto names = [](const std::string& text, const char* key) {
        EXPECT_NE(text.find(key), std::string::npos) << text;
    };
    names(problem([](gcc::Config& c) { c.image_buffer.bytes = 1000; }), "image_buffer.bytes");
    names(problem([](gcc::Config& c) {
              c.view_size = 4;
              c.image_buffer.bytes = 1 << 30;
          }),
          "image_buffer.bytes");
    names(problem([](gcc::Config& c) { c.clusters = 0; }), "clusters");
    names(problem([](gcc::Config& c) { c.clusters = 65; }), "clusters");
    names(problem([](gcc::Config& c) { // 65 views each, 4096 in all
              c.clusters = 64;
              c.image_buffer.bytes *= 65;
          }),
          "image_buffer.bytes");
    names(problem([](gcc::Config& c) { c.array.window = 1; }), "array.window");
    names(problem([](gcc::Config& c) { c.colour.block = 1; }), "colour.block");
    names(problem([](gcc::Config& c) { c.projection.group = 4096; }), "group_buffer_bytes");
    names(problem([](gcc::Config& c) {
              c.projection.group = 4096;
              c.projection.groups_ahead = 64;
              c.splat_bytes = 1024;
          }),
          "group_buffer_bytes");
}

// The least that the keys allow of everything.
TEST(SmallRunGccStages, TheSmallestGcc) {
    gcc::Config config = gcc_of(4, 1);
    config.group_buffer_bytes = 256;
    config.splat_bytes = 1;
    config.projection.group = 1;
    config.projection.units = config.colour.units = 1;
    config.grouping.chunk = config.grouping.chunks_in_flight = 1;
    config.grouping.writes_in_flight = 1;
    config.colour.chunk = 1;
    config.colour.block = 1;
    const FrameWorkload frame = test::random_frame(9, 30, 20, 4, 60);
    const GccRun run("run", config, {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    test::expect_reference(run);
}

} // namespace
} // namespace degs
