// SPDX-License-Identifier: Apache-2.0
// Stage IV of GCC on random frames: the image is the reference's, fragments are conserved, and
// exact fidelity is strict fidelity to the last counter, date and byte.
#include <type_traits>

#include "tests/baselines/gcc/gcc_array_bench.hpp"

namespace degs {
namespace {

using test::GccArrayBench;
using test::random_frame;

GccArrayBench::Options random_options(std::mt19937& random) {
    const auto among = [&](std::initializer_list<int> values) {
        return values.begin()[random() % values.size()];
    };
    GccArrayBench::Options options;
    options.array.window = among({8, 8, 4, 16, 32, 5});
    options.array.skip_cycles = among({0, 0, 1, 3});
    options.array.discovery_cycles = among({1, 1, 4, 8});
    options.array.writeback_cycles = among({1, 4, 9});
    options.contexts = among({1, 1, 2, 3});
    options.chunk = static_cast<std::uint32_t>(among({1, 16, 100}));
    options.chunk_cycles = static_cast<Cycle>(among({0, 0, 10, 300}));
    options.readout_cycles = static_cast<Cycle>(among({0, 10, 500}));
    options.listeners = static_cast<std::size_t>(among({0, 1}));
    options.block = among({8, 8, 4, 16, 7});
    return options;
}

/// Pixels are stored in single precision: one rounding either way.
void expect_image(const Image& image, const Image& reference) {
    ASSERT_EQ(image.rgb.size(), reference.rgb.size());
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        ASSERT_NEAR(image.rgb[i], reference.rgb[i], 1.2e-7 * std::max(1.0F, reference.rgb[i]));
    }
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        ASSERT_NEAR(image.transmittance[i], reference.transmittance[i], 1.2e-7);
        ASSERT_EQ(image.fragments[i], reference.fragments[i]);
    }
}

void expect_same(const GccArrayBench& a, const GccArrayBench& b) {
    using Stats = gcc::WindowArray::Stats;
    static_assert(std::is_trivially_copyable_v<Stats> && sizeof(Stats) % 8 == 0);
    EXPECT_EQ(std::memcmp(&a.stats(), &b.stats(), sizeof(Stats)), 0);
    EXPECT_EQ(a.image().rgb, b.image().rgb);
    EXPECT_EQ(a.image().transmittance, b.image().transmittance);
    EXPECT_EQ(a.image().fragments, b.image().fragments);
    ASSERT_EQ(a.done().size(), b.done().size());
    for (std::size_t i = 0; i < a.done().size(); ++i) {
        EXPECT_EQ(a.done()[i].date, b.done()[i].date);
        EXPECT_EQ(a.states()[i].date, b.states()[i].date);
    }
    ASSERT_EQ(a.blocks().size(), b.blocks().size());
    for (std::size_t i = 0; i < a.blocks().size(); ++i) {
        EXPECT_EQ(a.blocks()[i].first, b.blocks()[i].first);
    }
}

class GccArrayRandom : public ::testing::TestWithParam<unsigned> {};

TEST_P(GccArrayRandom, RendersTheReferenceInBothFidelities) {
    std::mt19937 random(500 + GetParam());
    GccArrayBench::Options options = random_options(random);
    const int tile = std::min(options.array.window * 64, random() % 3 == 0 ? 128 : 64);
    const FrameWorkload frame = random_frame(GetParam(), 40 + static_cast<int>(random() % 160),
                                             30 + static_cast<int>(random() % 120), tile, 300);
    const GccArrayBench exact("exact", frame, options);
    options.fidelity = Fidelity::Strict;
    const GccArrayBench strict("strict", frame, options);
    sc_core::sc_start();
    test::expect_sound(exact);
    ReferenceCounts counts;
    expect_image(exact.image(), render_reference(frame, counts));
    EXPECT_EQ(exact.stats().slots[Slot::Useful], counts.fragments);
    EXPECT_EQ(exact.stats().pixels_ended, counts.terminated);
    expect_same(exact, strict);
}

INSTANTIATE_TEST_SUITE_P(Random, GccArrayRandom, ::testing::Range(0U, 40U));

/// Timing cannot reach the pixels: windows of any size, waits or not, give the same bits.
TEST(GccArrayPixelsRandom, TheImageDoesNotDependOnTheWindow) {
    const FrameWorkload frame = random_frame(77, 150, 100, 64, 300);
    GccArrayBench::Options options;
    options.numbers = Arithmetic::Fp32;
    const GccArrayBench eight("eight", frame, options);
    options.array.window = 16;
    options.array.discovery_cycles = 8;
    options.array.skip_cycles = 2;
    const GccArrayBench sixteen("sixteen", frame, options);
    sc_core::sc_start();
    EXPECT_EQ(eight.image().rgb, sixteen.image().rgb);
    EXPECT_EQ(eight.image().transmittance, sixteen.image().transmittance);
    EXPECT_NE(eight.stats().window.cycles(), sixteen.stats().window.cycles());
}

} // namespace
} // namespace degs
