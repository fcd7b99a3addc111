// SPDX-License-Identifier: Apache-2.0
// Exponents as products of matrices: the multiplied-out form is the same q', in the order of the
// reduction, and its error is what the sizes of the terms allow.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "splat/frame/pixel_mask.hpp"
#include "splat/pixels/data_path.hpp"
#include "tests/modules/degs/soft_frame.hpp"
#include "tests/splat/pixels/checked_image.hpp"

namespace degs {
namespace {

constexpr int kTilePixels = 8;

/// q' of a pixel from its definition, in long double.
long double exponent_of(const ProjectedSplat& s, int x, int y) {
    const long double dx = x - static_cast<long double>(s.mu_x);
    const long double dy = y - static_cast<long double>(s.mu_y);
    const long double q =
        (s.cov_c * dx * dx - 2.0L * s.cov_b * dx * dy + s.cov_a * dy * dy) / s.det;
    return q - 2 * std::log(static_cast<long double>(s.opacity));
}

/// Sum of the sizes of all terms: each is rounded a few times, and every partial sum is below it.
template <class T>
double size_of_terms(const GemmRow<T>& v, double x, double y, const GemmSplat<T>& s, int ox,
                     int oy) {
    const double dx = std::abs(double(s.pixel_x - ox) + s.offset_x);
    const double dy = std::abs(double(s.pixel_y - oy) + s.offset_y);
    const double reach_x = dx + std::abs(x), reach_y = dy + std::abs(y);
    return std::abs(v[0]) * reach_x * reach_x + std::abs(v[2]) * reach_x * reach_y +
           std::abs(v[1]) * reach_y * reach_y + std::abs(s.fold);
}

template <class T>
void expect_exponents(int origin_of_image) {
    const FrameWorkload frame = test::soft_frame(3, 300, 160, 120, kTilePixels);
    const double epsilon = std::numeric_limits<T>::epsilon();
    for (const ProjectedSplat& splat : frame.splats) {
        const int px = static_cast<int>(std::lround(splat.mu_x));
        const int py = static_cast<int>(std::lround(splat.mu_y));
        const auto s = gemm_splat<T>(splat, px, py, 2 * std::log(splat.opacity));
        const int ox = origin_of_image == 0 ? 0 : px / kTilePixels * kTilePixels + kTilePixels / 2;
        const int oy = origin_of_image == 0 ? 0 : py / kTilePixels * kTilePixels + kTilePixels / 2;
        const GemmRow<T> v = s.row(ox, oy);
        for (int i = 0; i < kTilePixels * kTilePixels; ++i) {
            const int x = px / kTilePixels * kTilePixels + i % kTilePixels,
                      y = py / kTilePixels * kTilePixels + i / kTilePixels;
            const T got = gemm_product(v, gemm_monomials<T>(T(x - ox), T(y - oy)));
            // Mean, conic and fold are rounded once each; a term has at most 8 operations.
            const double bound = 16 * epsilon * size_of_terms(v, x - ox, y - oy, s, ox, oy);
            ASSERT_NEAR(got, static_cast<double>(exponent_of(splat, x, y)), bound);
        }
    }
}

TEST(ExponentGemm, IsTheCompletedSquareMultipliedOut) {
    for (const int origin : {0, 1}) {
        SCOPED_TRACE(origin);
        expect_exponents<double>(origin);
        expect_exponents<float>(origin);
    }
}

TEST(ExponentGemm, ByHand) {
    GemmSplat<double> s;
    s.pixel_x = 10;
    s.pixel_y = 7;
    s.offset_x = 0.5;
    s.a = 2;
    s.b = 0.25;
    s.c = 1;
    s.fold = -3;
    const GemmRow<double> v = s.row(8, 8); // the mean is (2.5, -1) from there
    EXPECT_EQ(v,
              (GemmRow<double>{2, 1, 0.5, -2 * (5 - 0.25), -2 * (0.625 - 1), 12.5 - 1.25 + 1 + 3}));
    // q' of the pixel (11, 8): 2 * 0.25 + 0.5 * 0.5 * 1 + 1 = 1.75, and 3 of the opacity.
    EXPECT_EQ(gemm_product(v, gemm_monomials<double>(3, 0)), 4.75);
}

// In double precision, against a loop of its own over pixels and splats: the same bits.
TEST(ExponentGemm, DataPathAddsInTheOrderOfTheReduction) {
    const FrameWorkload frame = test::soft_frame(9, 400, 64, 48, kTilePixels);
    DataPathOptions options = named_numbers("fp64");
    options.gemm = ExponentGemm{GemmOrigin::Tile, {}, {}};
    const auto path = make_data_path(options, kTilePixels, 1);
    path->add_frame(frame);
    const std::size_t tile = 3 * frame.tiles_x + 4;
    const int x0 = 4 * kTilePixels, y0 = 3 * kTilePixels;
    struct Pixel {
        double t = 1, rgb[3] = {0, 0, 0};
        bool live = true;
    } pixels[kTilePixels * kTilePixels];
    for (auto i = frame.tile_begin[tile]; i < frame.tile_begin[tile + 1]; ++i) {
        const ProjectedSplat& s = frame.splats[frame.tile_splats[i]];
        PixelTest test;
        test.splat = frame.tile_splats[i];
        test.mask = bits_between(0, kTilePixels);
        test.x = x0;
        test.y = y0;
        BlendOutcome outcomes[kTilePixels];
        path->test_rows(test, kTilePixels, outcomes);
        const double ax = s.cov_c / s.det, b = -s.cov_b / s.det, c = s.cov_a / s.det;
        const double dx = (std::nearbyint(s.mu_x) - (x0 + 4)) + (s.mu_x - std::nearbyint(s.mu_x));
        const double dy = (std::nearbyint(s.mu_y) - (y0 + 4)) + (s.mu_y - std::nearbyint(s.mu_y));
        const double e = (ax * dx * dx + 2 * b * dx * dy + c * dy * dy) - 2 * std::log(s.opacity);
        for (int p = 0; p < kTilePixels * kTilePixels; ++p) {
            const double x = p % kTilePixels - 4, y = p / kTilePixels - 4;
            double q = ax * (x * x);
            q += c * (y * y);
            q += 2 * b * (x * y);
            q += -2 * (ax * dx + b * dy) * x;
            q += -2 * (b * dx + c * dy) * y;
            q += e;
            Pixel& pixel = pixels[p];
            if (!(q <= 2 * std::log(255.0)) || !pixel.live) {
                continue;
            }
            const double alpha = std::min(0.99, std::exp(-0.5 * q));
            const double after = pixel.t * (1 - alpha);
            if (after < 1e-4) {
                pixel.live = false;
                continue;
            }
            for (int k = 0; k < 3; ++k) {
                pixel.rgb[k] += alpha * pixel.t * s.colour[k];
            }
            pixel.t = after;
        }
    }
    for (int p = 0; p < kTilePixels * kTilePixels; ++p) {
        const PixelValue value = path->read_pixel(0, p / kTilePixels, p % kTilePixels);
        EXPECT_EQ(value.transmittance, pixels[p].t) << p;
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(value.rgb[k], pixels[p].rgb[k]) << p;
        }
    }
}

// FP16 operands and FP32 sums: the exponent is off by no more than the roundings of the operands.
TEST(ExponentGemm, HalfOperandsCostWhatTheirRoundingCosts) {
    const FrameWorkload frame = test::soft_frame(5, 300, 96, 64, kTilePixels);
    const auto render = [&](const NumberFormat& operands) {
        DataPathOptions options = named_numbers("ideal");
        options.set = number_set("ideal");
        options.gemm = ExponentGemm{GemmOrigin::Tile, operands, NumberFormat()};
        return test::checked_image(frame, options).image;
    };
    const Image exact = test::checked_image(frame, named_numbers("fp64")).image;
    const auto largest = [&](const Image& image) {
        double worst = 0;
        for (std::size_t i = 0; i < image.rgb.size(); ++i) {
            worst = std::max(worst, std::abs(double(image.rgb[i]) - exact.rgb[i]));
        }
        return worst;
    };
    // The vector unit forms coefficients in single precision, whatever the operands are.
    EXPECT_LT(largest(render(parse_format("fp64"))), 0.005);
    EXPECT_LT(largest(render(parse_format("fp32"))), 0.005);
    const double half = largest(render(parse_format("fp16")));
    EXPECT_GT(half, 1e-3);
    EXPECT_LT(half, 0.5);
    EXPECT_GT(largest(render(parse_format("bf16"))), half);
}

} // namespace
} // namespace degs
