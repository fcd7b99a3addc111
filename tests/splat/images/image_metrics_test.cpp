// SPDX-License-Identifier: Apache-2.0
#include "splat/images/image_metrics.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "degs/error.hpp"

namespace degs {
namespace {

constexpr double kC1 = 1e-4, kC2 = 9e-4;

Image constant(int width, int height, float value) {
    Image image(width, height);
    image.rgb.assign(image.rgb.size(), value);
    return image;
}

Image noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    Image image(width, height);
    for (float& value : image.rgb) {
        value = uniform(random);
    }
    return image;
}

/// Normalised weight of the one-dimensional window at `distance` px.
double weight(int distance) {
    double sum = 0;
    for (int i = -5; i <= 5; ++i) {
        sum += std::exp(-i * i / 4.5);
    }
    return std::abs(distance) > 5 ? 0 : std::exp(-distance * distance / 4.5) / sum;
}

double ssim_term(double ma, double mb, double aa, double bb, double ab) {
    return (2 * ma * mb + kC1) * (2 * (ab - ma * mb) + kC2) /
           ((ma * ma + mb * mb + kC1) * (aa - ma * ma + bb - mb * mb + kC2));
}

/// The definition, as a two-dimensional sum over the whole image per pixel.
double brute_ssim(const Image& a, const Image& b) {
    double total = 0;
    for (std::size_t centre = 0; centre < a.rgb.size(); ++centre) {
        const int cx = static_cast<int>(centre / 3) % a.width;
        const int cy = static_cast<int>(centre / 3) / a.width;
        double sums[5] = {0, 0, 0, 0, 0};
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x) {
                const double w = weight(x - cx) * weight(y - cy);
                const double p = a.rgb[3 * a.at(x, y) + centre % 3];
                const double q = b.rgb[3 * b.at(x, y) + centre % 3];
                sums[0] += w * p;
                sums[1] += w * q;
                sums[2] += w * p * p;
                sums[3] += w * q * q;
                sums[4] += w * p * q;
            }
        }
        total += ssim_term(sums[0], sums[1], sums[2], sums[3], sums[4]);
    }
    return total / static_cast<double>(a.rgb.size());
}

TEST(ImageMetrics, IdenticalImages) {
    const Image image = noise(40, 30, 1);
    const ImageError error = compare_images(image, image);
    EXPECT_EQ(error.psnr_db, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(error.ssim, 1, 1e-12);
    EXPECT_EQ(error.max_abs_error, 0);
}

TEST(ImageMetrics, ConstantShiftGivesPsnrInClosedForm) {
    const ImageError tenth = compare_images(constant(20, 30, 0.5F), constant(20, 30, 0.625F));
    EXPECT_NEAR(tenth.psnr_db, 20 * std::log10(8.0), 1e-12);
    EXPECT_DOUBLE_EQ(tenth.max_abs_error, 0.125);
    // Values beyond [0, 1] are not clamped.
    EXPECT_NEAR(compare_images(constant(4, 4, 2), constant(4, 4, 4)).psnr_db, -20 * std::log10(2.0),
                1e-12);
}

TEST(ImageMetrics, OneMeanOverAllPixelsAndChannels) {
    Image test(10, 10);
    test.rgb[3 * test.at(4, 7) + 1] = -0.5F; // one of 300 values
    const ImageError error = compare_images(Image(10, 10), test);
    EXPECT_NEAR(error.psnr_db, 10 * std::log10(300 / 0.25), 1e-12);
    EXPECT_EQ(error.max_abs_error, 0.5);
}

// Zero padding: near the border the window of a constant image sums to s < 1.
TEST(ImageMetrics, SsimOfConstantImagesInClosedForm) {
    const int width = 14, height = 9;
    const double a = 0.25, b = 0.75;
    double expected = 0;
    for (int cy = 0; cy < height; ++cy) {
        for (int cx = 0; cx < width; ++cx) {
            double sx = 0, sy = 0;
            for (int x = 0; x < width; ++x) {
                sx += weight(x - cx);
            }
            for (int y = 0; y < height; ++y) {
                sy += weight(y - cy);
            }
            const double s = sx * sy;
            expected += ssim_term(s * a, s * b, s * a * a, s * b * b, s * a * b);
        }
    }
    const ImageError error =
        compare_images(constant(width, height, 0.25F), constant(width, height, 0.75F));
    EXPECT_NEAR(error.ssim, expected / (width * height), 1e-12);
}

TEST(ImageMetrics, SsimEqualsTheDefinition) {
    for (const auto& [width, height] : {std::pair(23, 17), {3, 70}, {40, 2}, {11, 11}, {1, 1}}) {
        const Image a = noise(width, height, 1);
        Image b = noise(width, height, 2);
        for (std::size_t i = 0; i < b.rgb.size(); ++i) {
            b.rgb[i] = 0.7F * a.rgb[i] + 0.3F * b.rgb[i];
        }
        const double ssim = compare_images(a, b).ssim;
        EXPECT_NEAR(ssim, brute_ssim(a, b), 1e-12) << width << " x " << height;
        EXPECT_LT(ssim, 1);
    }
}

TEST(ImageMetrics, SsimIsSymmetric) {
    const Image a = noise(30, 20, 5), b = noise(30, 20, 6);
    EXPECT_DOUBLE_EQ(compare_images(a, b).ssim, compare_images(b, a).ssim);
}

TEST(ImageMetrics, NonFinitePixelsAreNotHidden) {
    const Image good = constant(20, 20, 0.5F);
    Image bad = good;
    bad.rgb[600] = std::numeric_limits<float>::quiet_NaN();
    const ImageError nan = compare_images(good, bad);
    EXPECT_TRUE(std::isnan(nan.psnr_db));
    EXPECT_TRUE(std::isnan(nan.ssim));
    EXPECT_TRUE(std::isnan(nan.max_abs_error));
    bad.rgb[600] = std::numeric_limits<float>::infinity();
    const ImageError inf = compare_images(good, bad);
    EXPECT_EQ(inf.psnr_db, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(inf.max_abs_error, std::numeric_limits<double>::infinity());
}

// What is not a number is worse than an infinite error of the same pixel, and of one before it.
TEST(ImageMetrics, WhatIsNotANumberIsWorseThanInfinity) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const Image good = constant(4, 4, 0.5F);
    Image bad = good;
    bad.rgb[3] = infinity;
    bad.rgb[4] = nan;
    EXPECT_TRUE(std::isnan(compare_images(good, bad).max_abs_error));
    bad.rgb[4] = 0.5F;
    bad.rgb[40] = nan;
    EXPECT_TRUE(std::isnan(compare_images(good, bad).max_abs_error));
}

TEST(ImageMetrics, SizesMustAgree) {
    EXPECT_THROW(compare_images(Image(4, 3), Image(3, 4)), InputError);
    EXPECT_THROW(compare_images(Image(0, 0), Image(0, 0)), InputError);
    try {
        compare_images(Image(4, 3), Image(5, 3));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("5 x 3"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("4 x 3"), std::string::npos);
    }
}

TEST(ImageBytes, AreClampedAndRoundHalvesUp) {
    for (int step = 0; step <= 255; ++step) {
        const float value = static_cast<float>(step) / 255.0F;
        EXPECT_EQ(byte_of(value), step);
        EXPECT_EQ(byte_of(value - 0.49F / 255.0F), step);
        EXPECT_EQ(byte_of(value + 0.49F / 255.0F), step);
    }
    EXPECT_EQ(byte_of(0.5F), 128);
    EXPECT_EQ(byte_of(-1.0F), 0);
    EXPECT_EQ(byte_of(2.0F), 255);
    EXPECT_EQ(byte_of(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(byte_of(std::numeric_limits<float>::quiet_NaN()), 0);
}

} // namespace
} // namespace degs
