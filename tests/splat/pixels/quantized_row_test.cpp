// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/quantized_row.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

double exact_alpha(const ProjectedSplat& s, int x, int y) {
    const auto q = static_cast<double>(test::exact_q(s, x, y));
    return std::min(0.99, s.opacity * std::exp(-q / 2));
}

// The yardstick: spans, g0 and d0 of the double data path, up to rounding of double.
TEST(QuantizedRow, IdealIsTheDoubleDataPath) {
    std::mt19937 random(5);
    const QuantizedRow row(number_set("ideal"));
    int spans = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const ProjectedSplat splat = test::random_splat(random, 64, 128, 64);
        const auto path = test::path_of({splat}, test::path_options(Arithmetic::Fp64));
        const QuantizedSplat record = row.record(splat);
        for (int y = 128; y < 192; ++y) {
            const auto expected = path->solve_row(0, y, 64, 128, 128);
            const QuantizedSpan span = row.solve(record, y, 64, 128);
            ASSERT_EQ(span.empty(), !expected);
            if (!expected) {
                continue;
            }
            ++spans;
            ASSERT_EQ(span.x0, 64 + expected->x0);
            ASSERT_EQ(span.x1 - span.x0 + 1, expected->length);
            ASSERT_EQ(span.base, span.x0);
            // q - 2 ln o cancels down to 2 ln 255 at the ends of far needles.
            ASSERT_NEAR(span.g0, expected->g0, 1e-9);
            ASSERT_NEAR(span.d0, expected->d0, 1e-9);
        }
    }
    EXPECT_GT(spans, 20000);
}

TEST(QuantizedRow, WideSetsFollowTheEllipse) {
    std::mt19937 random(6);
    for (const char* name : {"ideal", "fp32", "tuned"}) {
        const QuantizedRow row(number_set(name));
        const bool coarse = std::string(name) == "tuned";
        for (int trial = 0; trial < 500; ++trial) {
            std::uniform_real_distribution<double> unit(0, 1);
            const double minor = 1 + 5 * unit(random);
            const ProjectedSplat splat = test::make_splat(
                4000 + 32 * unit(random), 2000 + 32 * unit(random), minor * (1 + 5 * unit(random)),
                minor, 6.3 * unit(random), 0.1 + 0.9 * unit(random));
            const QuantizedSplat record = row.record(splat);
            for (int y = 2000; y < 2032; ++y) {
                const QuantizedSpan span = row.solve(record, y, 4000, 4032);
                for (int x = span.x0; x <= span.x1; ++x) {
                    const double alpha =
                        row.alpha(record, row.q(record.a, span.g0, span.d0, x - span.base));
                    ASSERT_NEAR(alpha, exact_alpha(splat, x, y), coarse ? 1e-3 : 1e-5) << name;
                }
            }
        }
    }
}

// sigma in thousands of pixels, seen through tiles far from the mean, at 8K coordinates.
TEST(QuantizedRow, TunedAndPaperKeepLargeSplats) {
    struct Case {
        const char* name;
        double tolerance;
    };
    for (const Case& c : {Case{"tuned", 1e-3}, Case{"paper", 0.03}}) {
        const QuantizedRow row(number_set(c.name));
        for (const double sigma : {300.0, 1500.0, 4000.0}) {
            const ProjectedSplat splat =
                test::make_splat(-700.25, 3100.6, 2 * sigma, sigma, 0.7, 0.8);
            const QuantizedSplat record = row.record(splat);
            for (const int x0 : {0, 320, 1024, 4096, 7648}) {
                const QuantizedSpan span = row.solve(record, 2000, x0, x0 + 32);
                for (int x = x0; x < x0 + 32; ++x) {
                    const double truth = exact_alpha(splat, x, 2000);
                    const bool drawn = x >= span.x0 && x <= span.x1;
                    if (truth > 1.05 / 255 || drawn) {
                        ASSERT_TRUE(drawn) << c.name << " " << sigma << " " << x;
                        const double alpha =
                            row.alpha(record, row.q(record.a, span.g0, span.d0, x - span.base));
                        ASSERT_NEAR(alpha, truth, c.tolerance) << c.name << " " << sigma;
                    }
                }
            }
        }
    }
}

TEST(QuantizedRow, LiteralFp16LosesRowsBeyond256) {
    const ProjectedSplat splat = test::make_splat(16, 0, 200, 200, 0, 1);
    EXPECT_FALSE(QuantizedRow(number_set("ideal"))
                     .solve(QuantizedRow(number_set("ideal")).record(splat), 260, 0, 32)
                     .empty());
    const QuantizedRow half(number_set("fp16")); // 260^2 is more than 65 504
    EXPECT_TRUE(half.solve(half.record(splat), 260, 0, 32).empty());
}

/// A half by definition: whole multiples of its unit.
double half(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    const int unit = std::max(exponent - 11, -24);
    return std::ldexp(std::nearbyint(std::ldexp(x, -unit)), unit);
}

// Eq. 10-15 and 18 a second time, operation by operation in FP16; sqrt(1 - x) is one, as in the
// paper.
TEST(QuantizedRow, LiteralFp16RoundsEveryOperation) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> unit(0, 1);
    const QuantizedRow row(number_set("fp16"));
    const double limit = half(2 * std::log(255.0));
    for (int trial = 0; trial < 2000; ++trial) {
        const ProjectedSplat s =
            test::make_splat(8 + 16 * unit(random), 8 + 16 * unit(random), 2 + 3 * unit(random),
                             2 + unit(random), 6.3 * unit(random), 0.1 + 0.9 * unit(random));
        const double a = half(s.conic_a());
        const double b = half(s.conic_b());
        const double q_th = half(s.q_threshold);
        const double c_prime = half(half(s.conic_c()) - half(half(b * b) / a));
        const double inverse = half(c_prime / q_th);
        const int y = static_cast<int>(32 * unit(random));
        const double dy = half(y - half(s.mu_y));
        const double x = half(half(dy * dy) * inverse);
        const QuantizedSpan span = row.solve(row.record(s), y, 0, 32);
        if (x > 1) {
            ASSERT_TRUE(span.empty());
            continue;
        }
        const double w = half(half(std::sqrt(half(q_th / a))) * half(std::sqrt(1 - x)));
        const double centre = half(half(s.mu_x) + half(half(-b / a) * dy));
        const double left = std::max(0.0, std::floor(half(centre - w)));
        ASSERT_EQ(span.x0, left);
        ASSERT_EQ(span.x1, std::min(31.0, std::ceil(half(centre + w))));
        const double u = half(left - centre);
        const double level = half(half(half(dy * dy) * c_prime) + half(limit - q_th));
        ASSERT_EQ(span.g0, half(half(half(a * u) * u) + level));
        ASSERT_EQ(span.d0, half(a * half(2 * u + 1)));
        const double q =
            half(half(span.g0 + half(span.d0 * 5)) + half(a * 20)); // n = 5, n(n-1) = 20
        ASSERT_EQ(row.q(a, span.g0, span.d0, 5), q);
    }
}

TEST(QuantizedRow, OutwardEndsAreTheNextPixels) {
    NumberSet set = number_set("ideal");
    const ProjectedSplat splat = test::make_splat(10.3, 5, 2, 2, 0, 1);
    const double width = 2 * std::sqrt(2 * std::log(255.0));
    const QuantizedRow exact(set);
    QuantizedSpan span = exact.solve(exact.record(splat), 5, 0, 32);
    EXPECT_EQ(span.x0, std::ceil(10.3 - width));
    EXPECT_EQ(span.x1, std::floor(10.3 + width));
    set.ends = SpanEnds::Outward;
    const QuantizedRow outward(set);
    span = outward.solve(outward.record(splat), 5, 0, 32);
    EXPECT_EQ(span.x0, std::floor(10.3 - width));
    EXPECT_EQ(span.x1, std::ceil(10.3 + width));
    // A mask draws none of the pixels that outward ends add.
    set.q_mask = true;
    const QuantizedRow masked(set);
    const auto alpha = [&](int x) {
        const QuantizedSplat record = masked.record(splat);
        return masked.alpha(record, masked.q(record.a, span.g0, span.d0, x - span.base));
    };
    EXPECT_EQ(alpha(span.x0), 0);
    EXPECT_GT(alpha(span.x0 + 1), 1.0 / 256);
    EXPECT_EQ(alpha(span.x1), 0);
}

TEST(QuantizedRow, SteepEndsGetAnotherPixelIfDyIsCoarse) {
    NumberSet set = number_set("ideal");
    set.ends = SpanEnds::Slope;
    set.mean = parse_format("q16.0"); // dy is off by up to half a pixel
    const QuantizedRow row(set);
    const ProjectedSplat splat = test::make_splat(16, 16, 3, 3, 0, 1);
    const QuantizedSplat record = row.record(splat);
    const double r = 3 * std::sqrt(2 * std::log(255.0));
    for (int dy = -9; dy <= 9; ++dy) {
        // |dw/dy| = |dy| / w for a circle; half a pixel of it, to the nearest.
        const double w = std::sqrt(r * r - dy * dy);
        const double delta = std::min(1.0, std::round(0.5 * std::abs(dy) / w));
        const QuantizedSpan span = row.solve(record, 16 + dy, 0, 32);
        EXPECT_EQ(span.x0, std::floor(16 - w) - delta) << dy;
        EXPECT_EQ(span.x1, std::ceil(16 + w) + delta) << dy;
    }
}

TEST(QuantizedRow, HalvesOfAnIntegerAreRoundedAlone) {
    NumberSet set = number_set("fp16");
    const Rounder round(parse_format("fp16"));
    const double d = round(0.3337);
    for (const auto multiplier : {IntegerMultiplier::Whole, IntegerMultiplier::HalfLookup}) {
        set.multiplier = multiplier;
        const QuantizedRow row(set);
        for (int n = -60; n <= 60; ++n) {
            const int low = n < 0 ? -(-n % 16) : n % 16;
            const double expected = multiplier == IntegerMultiplier::Whole
                                        ? round(d * n)
                                        : round(round(d * low) + round(d * (n - low)));
            EXPECT_EQ(row.q(0, 0, d, n), expected) << n;
        }
    }
}

TEST(QuantizedRow, BlendsByTheRecurrence) {
    NumberSet set = number_set("tuned");
    const QuantizedRow row(set);
    const Rounder weight(set.weight);
    const Rounder sum(set.sum);
    const Rounder t(set.transmittance);
    QuantizedPixel pixel;
    QuantizedPixel exact;
    const double colour[3] = {0.25, 1.5, 0.75};
    for (const double alpha : {0.5, 0.125, 3277.0 / 65536, 0.9}) {
        const double before = pixel.transmittance;
        const double red = pixel.rgb[0];
        row.blend(alpha, colour, pixel);
        EXPECT_EQ(pixel.transmittance, t(before * t(1 - alpha)));
        EXPECT_EQ(pixel.rgb[0], sum(red + weight(weight(alpha * before) * 0.25)));
        for (int c = 0; c < 3; ++c) {
            exact.rgb[c] += exact.transmittance * alpha * colour[c];
        }
        exact.transmittance *= 1 - alpha;
        EXPECT_NEAR(pixel.rgb[1], exact.rgb[1], 4 * 0.5 / 16384 + 1e-4);
        EXPECT_NEAR(pixel.transmittance, exact.transmittance, 4 * 0.5 / 65536 + 1e-6);
    }
}

class HostileSplats : public testing::TestWithParam<std::string> {};

// No shape makes a span leave the tile or an alpha that is NaN.
TEST_P(HostileSplats, NeverLeaveTheTileOrTheNumbers) {
    const QuantizedRow row(number_set(GetParam()));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    int pixels = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const double minor = std::sqrt(0.3) * std::exp(9 * unit(random));
        const double far = std::pow(10.0, 7 * unit(random));
        ProjectedSplat splat = test::make_splat(
            far * (unit(random) - 0.5), far * (unit(random) - 0.5),
            minor * std::exp(6 * unit(random)), minor, 6.3 * unit(random),
            trial % 3 == 0 ? 1.0 / 255 : 1.0 / 255 + (1 - 1.0 / 255) * unit(random));
        splat.q_threshold = std::max(0.0, splat.q_threshold);
        const QuantizedSplat record = row.record(splat);
        const int y = static_cast<int>(splat.mu_y) + trial % 7;
        const int x0 = static_cast<int>(splat.mu_x) / 32 * 32;
        const QuantizedSpan span = row.solve(record, y, x0, x0 + 32);
        if (span.empty()) {
            continue;
        }
        ASSERT_GE(span.x0, x0);
        ASSERT_LT(span.x1, x0 + 32);
        for (int x = span.x0; x <= span.x1; ++x) {
            const double alpha =
                row.alpha(record, row.q(record.a, span.g0, span.d0, x - span.base));
            ASSERT_TRUE(alpha >= 0 && alpha <= 0.9905) << alpha;
            ++pixels;
        }
    }
    EXPECT_GT(pixels, 2000);
}
INSTANTIATE_TEST_SUITE_P(All, HostileSplats, testing::ValuesIn(number_set_names()));

// Opacity 1/255 on a pixel's centre: that pixel and no other (design H10).
TEST(QuantizedRow, SplatOfOnePixelIsDrawn) {
    for (const char* name : {"ideal", "fp32", "tuned"}) {
        const QuantizedRow row(number_set(name));
        ProjectedSplat splat = test::make_splat(7, 9, 3, 2, 0.4, 1.0 / 255);
        splat.q_threshold = 0;
        const QuantizedSplat record = row.record(splat);
        const QuantizedSpan span = row.solve(record, 9, 0, 32);
        EXPECT_EQ(span.x0, 7) << name;
        EXPECT_EQ(span.x1, 7) << name;
        EXPECT_TRUE(row.solve(record, 10, 0, 32).empty()) << name;
    }
}

} // namespace
} // namespace degs
