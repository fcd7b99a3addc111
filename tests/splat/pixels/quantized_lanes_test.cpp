// SPDX-License-Identifier: Apache-2.0
// Lanes against the definition, pixel by pixel.
#include "splat/pixels/quantized_lanes.hpp"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "accuracy/single_gaussian.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

constexpr int kWindowPixels = kAlphaWindow;

struct Work {
    QuantizedSplat splat;
    BlendTask task;
    BlendRecord<float> record;
};

/// A row of a random splat; false if it covers nothing.
bool make_work(const QuantizedRow& path, std::mt19937_64& random, Work& work) {
    ProjectedSplat splat = random_window_splat(random);
    if (random() % 4 == 0) {
        test::cut(splat, 4);
    }
    for (double& channel : splat.colour) {
        channel = static_cast<double>(random() % 1000) / 500;
    }
    work.splat = path.record(splat);
    const int y = static_cast<int>(random() % kWindowPixels);
    const QuantizedSpan span = path.solve(work.splat, y, 0, kWindowPixels);
    if (span.empty()) {
        return false;
    }
    work.task = {};
    work.task.g0 = span.g0;
    work.task.d0 = span.d0;
    work.task.offset = static_cast<std::int16_t>(-span.base);
    for (int x = span.x0; x <= span.x1; ++x) {
        work.task.mask |= 1U << x;
    }
    work.record = {static_cast<float>(work.splat.a), static_cast<float>(work.splat.colour[0]),
                   static_cast<float>(work.splat.colour[1]),
                   static_cast<float>(work.splat.colour[2]),
                   static_cast<float>(work.splat.q_inside)};
    return true;
}

/// What must become of one pixel.
struct ExpectedLane {
    QuantizedPixel pixel;
    bool live = true, useful = false, boundary = false, terminated = false, ended = false;
};

ExpectedLane expected(const QuantizedRow& path, const Work& work, int x, const PixelValue& before) {
    ExpectedLane e;
    e.live = !before.ended;
    e.pixel.transmittance = before.transmittance;
    std::copy_n(before.rgb, 3, e.pixel.rgb);
    if ((work.task.mask >> x & 1U) == 0) {
        return e;
    }
    const double q = path.q(work.splat.a, work.task.g0, work.task.d0, x + work.task.offset);
    QuantizedPixel next = e.pixel;
    path.blend(path.alpha(work.splat, q), work.splat.colour, next);
    e.ended = e.live && next.transmittance < 1e-4;
    const bool blended = e.live && !e.ended;
    e.pixel = blended ? next : e.pixel;
    e.boundary = q > work.splat.q_inside;
    e.useful = !e.boundary && blended;
    e.terminated = !e.boundary && !blended;
    e.live = e.live && !e.ended;
    return e;
}

/// "paper-vertex": halves of negative n, without the double rounding that tuned is allowed.
NumberSet set_of(const std::string& name) {
    if (name != "paper-vertex") {
        return number_set(name);
    }
    NumberSet set = number_set("paper");
    set.base = Base::Vertex;
    return set;
}

class Lanes : public testing::TestWithParam<const char*> {};

/// Differences are at most a unit of T, and of the colour a unit each of its weight and of their
/// product; they are as rare as ties of 24 bits.
TEST_P(Lanes, AreTheRowPath) {
    const std::string name = GetParam();
    const NumberSet set = set_of(name);
    const QuantizedRow path(set);
    const LaneNumbers numbers(set);
    const double tolerance = name == "tuned" ? 1.0 / (1 << 18) + 2.0 / (1 << 16) : 0;
    for (const QuantizedBlendFunction blend : quantized_blend_variants(numbers.family)) {
        std::mt19937_64 random(3);
        PixelPlanes<float> planes(kWindowPixels + kLanePadding);
        int compared = 0;
        int different = 0;
        int ended = 0;
        for (int trial = 0; trial < 6000; ++trial) {
            Work work;
            if (!make_work(path, random, work)) {
                continue;
            }
            if (trial % 100 == 0) {
                planes.clear(0, kWindowPixels);
            }
            const PixelPlanes<float> before = planes;
            const BlendOutcome outcome = blend(work.task, work.record, numbers, true, planes, 0);
            for (int x = 0; x < kWindowPixels; ++x) {
                const auto at = static_cast<std::size_t>(x);
                const ExpectedLane e = expected(path, work, x, before.read(at));
                const PixelValue after = planes.read(at);
                const auto bit = [x](std::uint32_t mask) { return (mask >> x & 1U) != 0; };
                ASSERT_EQ(bit(outcome.useful), e.useful);
                ASSERT_EQ(bit(outcome.boundary), e.boundary);
                ASSERT_EQ(bit(outcome.terminated), e.terminated);
                ASSERT_EQ(bit(outcome.ended), e.ended);
                ASSERT_EQ(after.ended, !e.live);
                ended += static_cast<int>(e.ended);
                const double error = std::abs(after.transmittance - e.pixel.transmittance) +
                                     std::abs(after.rgb[0] - e.pixel.rgb[0]);
                ASSERT_LE(error, tolerance);
                different += static_cast<int>(error > 0);
                compared += static_cast<int>(bit(work.task.mask));
            }
        }
        EXPECT_GT(compared, 30000);
        EXPECT_GT(ended, 20);
        EXPECT_LE(different, compared / 256);
    }
}

TEST_P(Lanes, AreTheSameAtEveryWidth) {
    const NumberSet set = set_of(GetParam());
    const QuantizedRow path(set);
    const LaneNumbers numbers(set);
    for (const bool refuse : {true, false}) {
        std::vector<PixelPlanes<float>> results;
        for (const QuantizedBlendFunction blend : quantized_blend_variants(numbers.family)) {
            std::mt19937_64 random(4);
            results.emplace_back(kWindowPixels + kLanePadding);
            for (int trial = 0; trial < 300; ++trial) {
                Work work;
                if (make_work(path, random, work)) {
                    work.task.mask &= static_cast<std::uint32_t>(random());
                    blend(work.task, work.record, numbers, refuse, results.back(), 0);
                }
            }
        }
        for (const PixelPlanes<float>& each : results) {
            EXPECT_EQ(each.transmittance, results.front().transmittance);
            EXPECT_EQ(each.r, results.front().r);
            EXPECT_EQ(each.g, results.front().g);
            EXPECT_EQ(each.b, results.front().b);
            EXPECT_EQ(each.live, results.front().live);
            EXPECT_EQ(each.updates, results.front().updates);
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Sets, Lanes, testing::Values("paper", "paper-vertex", "tuned"));

// The three ways to round are one arithmetic: a set that fits a fast family, computed in the
// general one, has the same bits.
TEST(LaneFamilies, ComputeTheSame) {
    for (const char* name : {"paper", "tuned"}) {
        const NumberSet set = number_set(name);
        const QuantizedRow path(set);
        const LaneNumbers numbers(set);
        EXPECT_EQ(numbers.family,
                  std::string(name) == "paper" ? LaneFamily::Half : LaneFamily::Fixed);
        std::mt19937_64 random(8);
        PixelPlanes<float> fast(kWindowPixels + kLanePadding);
        PixelPlanes<float> general(kWindowPixels + kLanePadding);
        for (int trial = 0; trial < 2000; ++trial) {
            Work work;
            if (!make_work(path, random, work)) {
                continue;
            }
            quantized_blend_function(numbers.family)(work.task, work.record, numbers, true, fast,
                                                     0);
            quantized_blend_function(LaneFamily::Any)(work.task, work.record, numbers, true,
                                                      general, 0);
            ASSERT_EQ(fast.transmittance, general.transmittance);
            ASSERT_EQ(fast.r, general.r);
        }
    }
}

TEST(LaneNumbers, RefusesWhatFloatsCannotCarry) {
    EXPECT_FALSE(lanes_can(number_set("ideal")));
    EXPECT_FALSE(lanes_can(number_set("fp16"))); // no table of the exponential
    EXPECT_THROW(LaneNumbers{number_set("ideal")}, InputError);
    NumberSet odd = number_set("tuned");
    odd.exp.entries = 24;
    EXPECT_FALSE(lanes_can(odd));
    EXPECT_TRUE(lanes_can(number_set("tuned")));
    NumberSet wide = number_set("tuned");
    wide.exp.argument = parse_format("q18.12"); // 31 bits, more than an fp32 lane carries
    EXPECT_FALSE(lanes_can(wide));
    wide = number_set("tuned");
    wide.exp.values = wide.exp.argument = parse_format("q18.12");
    EXPECT_FALSE(lanes_can(wide));
}

} // namespace
} // namespace degs
