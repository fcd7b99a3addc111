// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "accuracy/image_difference.hpp"
#include "splat/images/image_metrics.hpp"

namespace degs {
namespace {

/// Values that depend on the place.
Image pattern(int width, int height, float error) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        image.rgb[i] = static_cast<float>(i % 7) / 7 + error * static_cast<float>(i % 5);
    }
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        image.transmittance[i] = 0.5F - 2 * error * static_cast<float>(i % 3);
        image.fragments[i] = static_cast<std::uint32_t>(i);
    }
    return image;
}

TEST(ImageDifference, AgreesWithTheMetrics) {
    const Image a = pattern(20, 13, 0);
    Image b = pattern(20, 13, 0.01F);
    b.fragments[7] = 0;
    b.rgb[20] += 0.125F;
    ImageDifference difference;
    difference.add(a, b);
    const ImageError metrics = compare_images(a, b);
    EXPECT_NEAR(difference.psnr_db(), metrics.psnr_db, 1e-9);
    EXPECT_EQ(difference.max_abs_error(), metrics.max_abs_error);
    EXPECT_EQ(difference.pixels(), 260U);
    EXPECT_NEAR(difference.alpha_error_max(), 0.04, 1e-6);
    EXPECT_NEAR(difference.alpha_error_mean(), (0 * 87 + 0.02 * 87 + 0.04 * 86) / 260, 1e-6);
    EXPECT_EQ(difference.recounted(), 1U);
    EXPECT_FALSE(difference.identical());
}

TEST(ImageDifference, PartsAreAsGoodAsTheWhole) {
    const Image top = pattern(9, 4, 0);
    Image worse = top;
    worse.rgb[3 * top.at(5, 2) + 1] += 0.5F;
    ImageDifference difference;
    difference.add(top, top, 100, 200);
    EXPECT_TRUE(difference.identical());
    EXPECT_TRUE(std::isinf(difference.psnr_db()));
    difference.add(top, worse, 100, 240);
    EXPECT_EQ(difference.worst_x(), 105);
    EXPECT_EQ(difference.worst_y(), 242);
    EXPECT_NEAR(difference.psnr_db(), -10 * std::log10(0.25 / (2 * 36 * 3)), 1e-5);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ImageDifference, NumbersThatAreNoneAreCountedAndWorst) {
    const Image a = pattern(6, 6, 0);
    Image b = a;
    b.rgb[0] += 0.25F;
    b.rgb[3 * a.at(4, 3)] = std::numeric_limits<float>::quiet_NaN();
    b.transmittance[a.at(4, 3)] = std::numeric_limits<float>::infinity();
    b.rgb[3 * a.at(5, 5)] += 0.5F;
    ImageDifference difference;
    difference.add(a, b);
    EXPECT_EQ(difference.nonfinite(), 2U);
    EXPECT_TRUE(std::isnan(difference.max_abs_error()));
    EXPECT_TRUE(std::isnan(difference.psnr_db()));
    EXPECT_EQ(difference.alpha_error_max(), kInfinity);
    EXPECT_EQ(difference.worst_x(), 4); // it is worse than any error
    EXPECT_EQ(difference.worst_y(), 3);
    EXPECT_FALSE(difference.identical());
}

TEST(ImageDifference, AnInfiniteErrorIsTheLargest) {
    const Image a = pattern(6, 6, 0);
    Image b = a;
    b.rgb[3 * a.at(2, 1)] += 275;
    b.rgb[3 * a.at(3, 4) + 2] = -std::numeric_limits<float>::infinity();
    b.rgb[3 * a.at(5, 5)] += 300;
    ImageDifference difference;
    difference.add(a, b);
    EXPECT_EQ(difference.max_abs_error(), kInfinity);
    EXPECT_EQ(difference.psnr_db(), -kInfinity);
    EXPECT_EQ(difference.nonfinite(), 1U);
    EXPECT_EQ(difference.worst_x(), 3);
    EXPECT_EQ(difference.worst_y(), 4);
    const ImageError metrics = compare_images(a, b);
    EXPECT_EQ(metrics.max_abs_error, kInfinity);
    EXPECT_EQ(metrics.psnr_db, -kInfinity);
}

/// Colours that are off by 0.0015 at most, and a transmittance that is by 0.005.
TEST(ImageDifference, TheLargestErrorMayBeOfTheTransmittance) {
    const Image a = pattern(6, 6, 0);
    Image b = a;
    b.rgb[7] += 0.0015F;
    b.transmittance[a.at(1, 4)] -= 0.005F;
    ImageDifference difference;
    difference.add(a, b);
    EXPECT_NEAR(difference.max_abs_error(), 0.005, 1e-6);
    EXPECT_NEAR(compare_images(a, b).max_abs_error, 0.005, 1e-6);
    EXPECT_EQ(difference.worst_x(), 1);
    EXPECT_EQ(difference.worst_y(), 4);
    EXPECT_NEAR(difference.psnr_db(), -10 * std::log10(0.0015 * 0.0015 / (36 * 3)), 1e-2);
}

TEST(ImageDifference, OfEqualErrorsTheFirstIsTheWorst) {
    const Image a(6, 6);
    Image b = a;
    b.rgb[3 * b.at(1, 2)] = b.rgb[3 * b.at(4, 2) + 2] = b.rgb[3 * b.at(0, 5) + 1] = 0.5F;
    ImageDifference difference;
    difference.add(a, b);
    EXPECT_EQ(difference.worst_x(), 1);
    EXPECT_EQ(difference.worst_y(), 2);
}

TEST(ImageDifference, Subtracts) {
    const Image a = pattern(5, 5, 0);
    Image b = pattern(5, 5, 0.01F);
    b.fragments[3] = 1;
    subtract(a, b);
    EXPECT_NEAR(b.rgb[9], 0.04, 1e-6); // 9 % 5 = 4
    EXPECT_NEAR(b.transmittance[2], -0.04, 1e-6);
    EXPECT_EQ(b.fragments[3], 2U);
    EXPECT_EQ(b.fragments[4], 0U);
}

} // namespace
} // namespace degs
