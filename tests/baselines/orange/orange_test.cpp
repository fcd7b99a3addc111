// SPDX-License-Identifier: Apache-2.0
// The whole ORANGE: nothing is lost, the image is right, dates are those of the rule, run-ahead
// changes nothing.
#include <random>

#include "tests/baselines/orange/orange_fixture.hpp"
#include "tests/modules/degs/soft_frame.hpp"
#include "tests/splat/pixels/checked_image.hpp"

namespace degs {
namespace {

using test::orange_of;
using test::OrangeRun;
using test::random_frame;

struct OrangeShape {
    int tile, cores, side;
};
std::ostream& operator<<(std::ostream& out, const OrangeShape& s) {
    return out << s.tile << "px_" << s.cores << "x" << s.side;
}

class SmallRunOrangeShape : public ::testing::TestWithParam<OrangeShape> {};

TEST_P(SmallRunOrangeShape, RendersTheReference) {
    const OrangeShape& shape = GetParam();
    const FrameWorkload frame = random_frame(7, 150, 90, shape.tile, 300);
    const OrangeRun run("orange", orange_of(shape.tile, shape.cores, shape.side, shape.side),
                        {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    test::expect_reference(run);
}
INSTANTIATE_TEST_SUITE_P(Points, SmallRunOrangeShape,
                         ::testing::Values(OrangeShape{8, 1, 32}, OrangeShape{8, 4, 32},
                                           OrangeShape{16, 2, 8}, OrangeShape{32, 1, 128},
                                           OrangeShape{20, 3, 7}, OrangeShape{4, 2, 1}));

TEST(SmallRunOrange, NoSplatsAtAll) {
    const FrameWorkload frame = test::make_frame({}, 40, 30, 8);
    const OrangeRun run("orange", orange_of(8, 2), {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    EXPECT_GT(run.result().cycles, 0U); // the background is written
}

/// Every splat lies on the one tile.
FrameWorkload stack(int count, double opacity = 0.01) {
    return test::make_frame(std::vector<ProjectedSplat>(count, test::blanket(4, 4, 20, opacity)), 8,
                            8, 8);
}

// One core, one tile, batches of 256: the array works on them one after the other, and the vector
// unit is faster.
TEST(SmallRunOrange, BatchesFollowEachOtherInTheArray) {
    const FrameWorkload frame = stack(700);
    BuildOptions alone;
    alone.array_only = true;
    const orange::Config config = orange_of(8, 1);
    const OrangeRun run("orange", config, {&frame}, Fidelity::Exact, alone);
    sc_core::sc_start();
    test::expect_sound(run);
    const AcceleratorResult result = run.result();
    const orange::SystolicArray::Config& array = config.cores.array;
    const Cycle busy = 2 * array.cycles(256, 64) + array.cycles(188, 64);
    EXPECT_EQ(busy, 2U * 2 * (256 + 62) + 2 * (188 + 62));
    EXPECT_EQ(result.window.cycles(), busy);
    EXPECT_EQ(result.slots[Slot::Starved], 0U);
    EXPECT_EQ(result.slots.executed(), 700U * 64 * 6);
    EXPECT_EQ(result.slots[Slot::Padding], busy * 1024 - 700U * 64 * 6);
}

// A vector unit of few lanes is what limits: products come first, so the array waits for
// coefficients.
TEST(SmallRunOrange, ANarrowVectorUnitStarvesTheArray) {
    const FrameWorkload frame = stack(256 * 6, 0.005);
    BuildOptions alone;
    alone.array_only = true;
    orange::Config config = orange_of(8, 1);
    config.cores.vector.lanes = 64;
    const OrangeRun run("orange", config, {&frame}, Fidelity::Exact, alone);
    sc_core::sc_start();
    test::expect_sound(run);
    const orange::VectorUnit::Stats& vector = run.orange().vector_units()[0]->stats();
    EXPECT_EQ(vector.blend_cycles, 6U * 256 * 64 * 10 / 64);
    EXPECT_EQ(vector.coefficient_cycles, 6U * 256 * 17 / 64);
    EXPECT_EQ(vector.busy, vector.blend_cycles + vector.coefficient_cycles);
    // But for the first product, on which it waits, and the rings, it works all the time.
    const Cycle first = config.cores.array.cycles(256, 64);
    EXPECT_LE(run.result().window.cycles(), vector.busy + first);
    EXPECT_GT(run.result().slots[Slot::Starved], run.result().slots.executed());
    EXPECT_EQ(run.result().slots[Slot::Blocked], 0U);
}

// Opaque splats end every pixel of the tile within the first batch: what is fetched or multiplied
// by then is thrown away.
TEST(SmallRunOrange, LeavesATileAfterTheBatchThatEndsIt) {
    const FrameWorkload frame = stack(256 * 20, 0.9);
    orange::Config config = orange_of(8, 1);
    const OrangeRun leaves("leaves", config, {&frame});
    config.cores.vector.termination = orange::Termination::None;
    const OrangeRun stays("stays", config, {&frame});
    sc_core::sc_start();
    test::expect_sound(leaves);
    test::expect_sound(stays);
    test::expect_reference(leaves);
    test::expect_reference(stays);
    const auto blended = [](const OrangeRun& run) {
        return run.orange().vector_units()[0]->stats().splats_blended;
    };
    EXPECT_EQ(blended(leaves), 256U);
    EXPECT_EQ(blended(stays), 256U * 20);
    EXPECT_EQ(leaves.result().slots[Slot::Useful], stays.result().slots[Slot::Useful]);
    EXPECT_LT(leaves.result().cycles, stays.result().cycles);
}

class SmallRunOrangeNumbers : public ::testing::TestWithParam<Arithmetic> {};

// Every pixel of a tile tests every splat of its list, so the image is that of all pixels, bit by
// bit.
TEST_P(SmallRunOrangeNumbers, ImageIsThatOfItsPixels) {
    orange::Config config = orange_of(8, 2);
    config.pipeline.numbers = GetParam();
    const FrameWorkload frame = test::soft_frame(5, 600, 72, 50, 8);
    const test::BlendedImage tile = test::checked_image(frame, config.data_path());
    const OrangeRun centred("centred", config, {&frame});
    config.gemm.origin = GemmOrigin::Image;
    const test::BlendedImage image = test::checked_image(frame, config.data_path());
    const OrangeRun cornered("cornered", config, {&frame});
    sc_core::sc_start();
    test::expect_sound(centred);
    EXPECT_EQ(centred.result().fragments(), tile.useful);
    EXPECT_TRUE(test::same_bytes(centred.image(), tile.image));
    EXPECT_EQ(cornered.result().fragments(), image.useful);
    EXPECT_TRUE(test::same_bytes(cornered.image(), image.image));
    if (GetParam() == Arithmetic::Fp32) { // whose rounding shows
        EXPECT_FALSE(test::same_bytes(cornered.image(), centred.image()));
    }
}
INSTANTIATE_TEST_SUITE_P(Numbers, SmallRunOrangeNumbers,
                         ::testing::Values(Arithmetic::Fp32, Arithmetic::Fp64, Arithmetic::Fp16,
                                           Arithmetic::Paper));

/// A random ORANGE and random frames.
class RandomOrange {
public:
    explicit RandomOrange(unsigned seed) : random_(seed) {}
    int upto(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    bool chance(int n) { return upto(n) == 0; }
    int among(std::initializer_list<int> values) {
        return *(values.begin() + upto(static_cast<int>(values.size())));
    }
    orange::Config config() {
        const int tile = among({8, 8, 16, 12, 32});
        const int cores = 1 + upto(4);
        orange::Config c = orange_of(tile, cores, among({32, 2, 6, 128, 1}), among({32, 2, 64, 5}));
        c.cores.array.dataflow = chance(3) ? orange::Dataflow::Output : orange::Dataflow::Weight;
        c.cores.array.fill = chance(2)   ? orange::Fill::Pass
                             : chance(2) ? orange::Fill::Batch
                                         : orange::Fill::None;
        c.cores.array.preload = !chance(3);
        c.cores.vector.lanes = among({512, 64, 1, 4096});
        c.cores.vector.coefficient_operations = among({17, 0, 100});
        c.cores.vector.blend_operations = among({10, 1});
        c.cores.vector.latency_cycles = among({16, 0, 300});
        c.cores.vector.termination =
            chance(3) ? orange::Termination::None : orange::Termination::Batch;
        c.gemm.origin = chance(3) ? GemmOrigin::Image : GemmOrigin::Tile;
        c.scratchpad.splat_batches = among({2, 1, 4});
        c.scratchpad.coefficient_batches = among({2, 1, 3});
        c.scratchpad.product_batches = among({2, 1, 3});
        c.pixel_buffer.bytes = c.pixel_buffer.bytes / 2 * among({1, 1, 2, 3});
        c.pixel_buffer.readout_pixels = among({64, 1, 1024});
        c.fetching.chunk = among({256, 16, 1, 7});
        c.fetching.chunks_in_flight = among({2, 1, 8});
        c.sorting.count = among({4, 1, 3});
        c.sorting.chunk = among({256, 16});
        c.monitor.cancel = !chance(3);
        c.monitor.latency_cycles = among({8, 1, 50});
        c.frames_in_flight = among({2, 1, 3});
        c.tile_order = static_cast<TileOrder>(among({0, 1}));
        c.memory.latency_ns = among({100, 10, 1000});
        return c;
    }

private:
    std::mt19937 random_;
};

class SmallRunOrangeFidelity : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunOrangeFidelity, ExactIsStrict) {
    RandomOrange draw(GetParam());
    const orange::Config config = draw.config();
    std::vector<FrameWorkload> frames;
    for (int f = draw.chance(3) ? 4 : 1; f > 0; --f) {
        frames.push_back(random_frame(GetParam() * 10 + static_cast<unsigned>(f), 1 + draw.upto(90),
                                      1 + draw.upto(70), config.tile_size,
                                      draw.among({1, 10, 60, 200})));
        frames.back().gaussians = frames.back().splats.size();
    }
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    BuildOptions options;
    options.array_only = draw.chance(4);
    const OrangeRun exact("exact", config, list, Fidelity::Exact, options);
    const OrangeRun strict("strict", config, list, Fidelity::Strict, options);
    sc_core::sc_start();
    test::expect_sound(exact);
    test::expect_reference(exact);
    exact.signature().expect_same(strict.signature());
    for (std::size_t f = 0; f < frames.size(); ++f) {
        EXPECT_TRUE(test::same_bytes(exact.job().images[f], strict.job().images[f]));
    }
}
INSTANTIATE_TEST_SUITE_P(Random, SmallRunOrangeFidelity, ::testing::Range(0U, 80U));

// Slots with their dates: what the recorder has of each tile adds up to the account.
TEST(SmallRunOrange, RecordedSlotsAreThoseOfTheAccount) {
    const FrameWorkload frame = random_frame(3, 100, 60, 8, 200);
    const OrangeRun run("orange", orange_of(8, 3), {&frame}, Fidelity::Exact, {},
                        test::Watch::Tiles);
    sc_core::sc_start();
    run.job().recorder->close();
    SlotAccount recorded;
    for (const TileActivity& tile : run.job().recorder->tiles()) {
        recorded += tile.slots;
    }
    const SlotAccount slots = run.result().slots;
    for (const SlotClass& each : kSlotClasses) {
        EXPECT_EQ(recorded[each.slot], slots[each.slot]) << each.name;
    }
}

TEST(HostileOrangeConfig, ProblemsAreOneSentenceThatNamesTheKeys) {
    const auto problem = [](void (*change)(orange::Config&)) {
        orange::Config config;
        change(config);
        return config.problem();
    };
    EXPECT_EQ(problem([](orange::Config&) {}), "");
    EXPECT_NE(
        problem([](orange::Config& c) { c.scratchpad.bytes = 1024; }).find("scratchpad.bytes"),
        std::string::npos);
    EXPECT_NE(problem([](orange::Config& c) { c.fetching.chunk = 1024; }).find("scratchpad.bytes"),
              std::string::npos);
    EXPECT_NE(
        problem([](orange::Config& c) { c.pixel_buffer.bytes = 64; }).find("pixel_buffer.bytes"),
        std::string::npos);
    EXPECT_NE(problem([](orange::Config& c) { c.tile_size = 33; }).find("tile_size"),
              std::string::npos);
}

} // namespace
} // namespace degs
