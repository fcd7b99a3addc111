// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/blend_lanes.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

namespace degs {
namespace {

/// One lane in double, by the words of the paper (Eq. 8, 18, 20).
struct Lane {
    double transmittance = 1, rgb[3] = {0, 0, 0};
    bool live = true;
    std::uint32_t updates = 0;
    double q = 0, next = 0; ///< what the last splat's decisions were made from
    bool useful = false, boundary = false, terminated = false, ended = false;

    void blend(const BlendTask& task, const BlendRecord<double>& splat, bool refuse, int lane) {
        const double n = task.offset + lane;
        q = task.g0 + n * task.d0 + splat.a * (n * (n - 1));
        const double alpha = std::min(0.99, std::exp(-0.5 * q));
        next = transmittance * (1 - alpha);
        ended = live && next < 1e-4;
        const bool blended = live && !(ended && refuse);
        const bool inside = q <= 2 * std::log(255.0);
        useful = inside && blended;
        boundary = !inside;
        terminated = inside && !blended;
        if (blended) {
            rgb[0] += alpha * transmittance * splat.r;
            rgb[1] += alpha * transmittance * splat.g;
            rgb[2] += alpha * transmittance * splat.b;
            transmittance = next;
            ++updates;
        }
        live = live && !ended;
    }
    /// Too close to a threshold for a format whose q is right to `slack`.
    bool close_call(double slack) const {
        return std::abs(q - 2 * std::log(255.0)) < slack || std::abs(next - 1e-4) < 1e-4 * slack ||
               std::abs(q + 2 * std::log(0.99)) < slack;
    }
};

constexpr std::size_t kRowPixels = 96;
constexpr std::size_t kFirst = 32; ///< pixel of mask bit 0

template <class T>
struct Planes {
    PixelPlanes<T> pixels{kRowPixels + kLanePadding};
    Lane read(std::size_t i) const {
        const PixelValue value = pixels.read(i);
        Lane lane;
        lane.transmittance = value.transmittance;
        std::copy_n(value.rgb, 3, lane.rgb);
        lane.live = !value.ended;
        lane.updates = value.updates;
        return lane;
    }
    bool same(const Planes& o, std::size_t i) const {
        const auto bits = [i](const std::vector<T>& a, const std::vector<T>& b) {
            return std::memcmp(&a[i], &b[i], sizeof(T)) == 0;
        };
        return bits(pixels.transmittance, o.pixels.transmittance) && bits(pixels.r, o.pixels.r) &&
               bits(pixels.g, o.pixels.g) && bits(pixels.b, o.pixels.b) &&
               bits(pixels.live, o.pixels.live) && pixels.updates[i] == o.pixels.updates[i];
    }
};

/// Pixels in the middle of their lives: some fresh, some nearly opaque, some ended.
template <class T>
Planes<T> random_planes(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    Planes<T> planes;
    for (std::size_t i = 0; i < kRowPixels + kLanePadding; ++i) {
        planes.pixels.transmittance[i] = static_cast<T>(std::pow(10.0, -4 * unit(random)));
        planes.pixels.r[i] = static_cast<T>(unit(random));
        planes.pixels.g[i] = static_cast<T>(unit(random));
        planes.pixels.b[i] = static_cast<T>(unit(random));
        planes.pixels.live[i] = T(random() % 4 == 0 ? 0 : 1);
        planes.pixels.updates[i] = static_cast<std::uint32_t>(random() % 100);
    }
    return planes;
}

/// A row of an ellipse across the 32 lanes, its vertex anywhere near them.
BlendTask random_task(std::mt19937& random, double a) {
    std::uniform_real_distribution<double> unit(0, 1);
    BlendTask task;
    const double start = -40 * unit(random); // first pixel relative to the centre
    task.offset = static_cast<std::int16_t>(static_cast<int>(random() % 64) - 32);
    task.g0 = a * start * start + 8 * unit(random) - 0.02; // may ask for alpha > 0.99
    task.d0 = a * (2 * start + 1);
    const auto bits = static_cast<std::uint32_t>(random());
    const int length = 1 + static_cast<int>(random() % 32);
    const std::uint32_t run = (length == 32 ? ~0U : (1U << length) - 1U) << (random() % 32);
    task.mask = random() % 3 == 0 ? bits : run; // both shapes that the modules make
    return task;
}

template <class T>
void expect_scalar_recurrence(BlendFunction<T> blend, bool refuse, double relative,
                              double q_relative) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    int compared = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const auto a = static_cast<double>(static_cast<T>(0.3 * std::pow(10.0, -4 * unit(random))));
        BlendTask task = random_task(random, a);
        task.g0 = static_cast<double>(static_cast<T>(task.g0));
        task.d0 = static_cast<double>(static_cast<T>(task.d0));
        const BlendRecord<T> splat{static_cast<T>(a), T(0.25), T(0.5), T(2)};
        const Planes<T> before = random_planes<T>(random);
        Planes<T> after = before;
        const BlendOutcome outcome = blend(task, splat, refuse, after.pixels, kFirst);

        ASSERT_EQ(outcome.useful & outcome.boundary, 0U);
        ASSERT_EQ(outcome.useful & outcome.terminated, 0U);
        ASSERT_EQ(outcome.boundary & outcome.terminated, 0U);
        ASSERT_EQ(outcome.useful | outcome.boundary | outcome.terminated, task.mask);
        ASSERT_EQ(outcome.ended & ~task.mask, 0U);
        for (std::size_t i = 0; i < kRowPixels + kLanePadding; ++i) {
            const bool lane = i >= kFirst && i < kFirst + 32;
            const auto bit = static_cast<int>(i - kFirst);
            if (!lane || (task.mask >> bit & 1U) == 0) {
                ASSERT_TRUE(after.same(before, i)) << "pixel " << i << " has no task";
                continue;
            }
            Lane expected = before.read(i);
            expected.blend(task, {a, 0.25, 0.5, 2}, refuse, bit);
            // Rounding of q: each of its three terms, which may cancel.
            const double n = task.offset + bit;
            const double q_error =
                q_relative * (std::abs(task.g0) + std::abs(n * task.d0) + a * n * n + 1);
            if (expected.close_call(2 * q_error + 4 * relative)) {
                continue;
            }
            ++compared;
            const auto has = [bit](std::uint32_t mask) { return (mask >> bit & 1U) != 0; };
            ASSERT_EQ(has(outcome.useful), expected.useful);
            ASSERT_EQ(has(outcome.boundary), expected.boundary);
            ASSERT_EQ(has(outcome.terminated), expected.terminated);
            ASSERT_EQ(has(outcome.ended), expected.ended);
            const Lane got = after.read(i);
            ASSERT_EQ(got.live, expected.live);
            ASSERT_EQ(got.updates, expected.updates);
            // alpha is right to q_error / 2 and the exponential's own error; 1 - alpha >= 0.01.
            const double tolerance = 2 * q_error + 4 * relative;
            ASSERT_NEAR(got.transmittance, expected.transmittance, tolerance);
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(got.rgb[channel], expected.rgb[channel], 2 * tolerance + 4 * relative);
            }
        }
    }
    EXPECT_GT(compared, 150000);
}

class BlendLanes : public ::testing::TestWithParam<bool> {};

TEST_P(BlendLanes, FloatFollowsTheScalarRecurrence) {
    for (const BlendFunction<float> variant : blend_variants()) {
        expect_scalar_recurrence<float>(variant, GetParam(), 3e-7, 4 * 0x1p-24);
    }
}

TEST_P(BlendLanes, DoubleFollowsTheScalarRecurrence) {
    expect_scalar_recurrence<double>(blend_function(0.0), GetParam(), 1e-15, 4 * 0x1p-53);
}

// Wide or narrow vectors, blocks that start anywhere: the same bits.
TEST_P(BlendLanes, VariantsGiveTheSameBits) {
    const std::vector<BlendFunction<float>> variants = blend_variants();
    ASSERT_FALSE(variants.empty());
    std::mt19937 random(12);
    for (int trial = 0; trial < 3000; ++trial) {
        const BlendRecord<float> splat{0.05F, 0.3F, 0.6F, 0.9F};
        const BlendTask task = random_task(random, 0.05);
        const Planes<float> before = random_planes<float>(random);
        Planes<float> first = before;
        const BlendOutcome expected = variants[0](task, splat, GetParam(), first.pixels, kFirst);
        for (const BlendFunction<float> variant : variants) {
            Planes<float> planes = before;
            const BlendOutcome outcome = variant(task, splat, GetParam(), planes.pixels, kFirst);
            ASSERT_EQ(outcome.useful, expected.useful);
            ASSERT_EQ(outcome.boundary, expected.boundary);
            ASSERT_EQ(outcome.terminated, expected.terminated);
            ASSERT_EQ(outcome.ended, expected.ended);
            for (std::size_t i = 0; i < kRowPixels + kLanePadding; ++i) {
                ASSERT_TRUE(planes.same(first, i));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(StopRules, BlendLanes, ::testing::Values(true, false),
                         [](const auto& rule) { return rule.param ? "Refuse" : "After"; });

/// A task for one pixel whose q' is `q`.
BlendTask single(double q) {
    BlendTask task;
    task.mask = 1;
    task.g0 = q;
    return task;
}

// T = 0.01 after one splat of alpha 0.99, then 1e-4, then below: refused, or blended and ended.
TEST(BlendLanesStop, RefuseOrAfter) {
    const BlendRecord<double> splat{0, 1, 1, 1};
    for (const bool refuse : {true, false}) {
        PixelPlanes<double> pixels(1 + kLanePadding);
        const BlendFunction<double> blend = blend_function(0.0);
        const double strong = -2 * std::log(0.98); // alpha 0.98: T = 0.02, 4e-4, 8e-6
        EXPECT_EQ(blend(single(strong), splat, refuse, pixels, 0).useful, 1U);
        EXPECT_EQ(blend(single(strong), splat, refuse, pixels, 0).useful, 1U);
        EXPECT_NEAR(pixels.transmittance[0], 4e-4, 1e-15);
        const BlendOutcome last = blend(single(strong), splat, refuse, pixels, 0);
        EXPECT_EQ(last.ended, 1U);
        EXPECT_EQ(last.useful, refuse ? 0U : 1U);
        EXPECT_EQ(last.terminated, refuse ? 1U : 0U);
        EXPECT_NEAR(pixels.transmittance[0], refuse ? 4e-4 : 8e-6, 1e-15);
        EXPECT_EQ(pixels.updates[0], refuse ? 2U : 3U);
        // Nothing changes an ended pixel, weak splats that would fit included.
        const BlendOutcome weak = blend(single(6), splat, refuse, pixels, 0);
        EXPECT_EQ(weak.terminated, 1U);
        EXPECT_EQ(weak.ended, 0U);
        EXPECT_EQ(pixels.updates[0], refuse ? 2U : 3U);
        EXPECT_EQ(blend(single(12), splat, refuse, pixels, 0).boundary, 1U);
    }
}

TEST(BlendLanesStop, AlphaIsClampedAt099) {
    const BlendRecord<float> splat{0, 1, 1, 1};
    for (const BlendFunction<float> blend : blend_variants()) {
        for (const double q : {0.0, -1e-3, 0.0201}) { // alpha 1, above 1, just below 0.99
            PixelPlanes<float> pixels(1 + kLanePadding);
            blend(single(q), splat, true, pixels, 0);
            const double alpha = std::min(0.99, std::exp(-q / 2));
            EXPECT_NEAR(pixels.r[0], alpha, 3e-7);
            EXPECT_NEAR(pixels.transmittance[0], 1 - alpha, 3e-7);
        }
    }
}

TEST(LaneExp, RelativeErrorOverItsWholeRange) {
    double worst = 0;
    for (int i = 0; i <= 2'000'000; ++i) {
        const auto x = static_cast<float>(-80.0 + 81.0 * i / 2e6);
        const double exact = std::exp(static_cast<double>(x));
        worst = std::max(worst, std::abs(lane_exp(x) - exact) / exact);
    }
    EXPECT_LT(worst, 3e-7);
    EXPECT_GT(worst, 1e-8); // it is a float
}

TEST(LaneExp, ZeroIsOneAndFarBelowIsTiny) {
    EXPECT_EQ(lane_exp(0.0F), 1.0F);
    for (const float x : {-80.5F, -200.0F, -1e30F, -std::numeric_limits<float>::infinity()}) {
        EXPECT_EQ(lane_exp(x), lane_exp(-80.0F));
    }
}

} // namespace
} // namespace degs
