// SPDX-License-Identifier: Apache-2.0
#include "accuracy/flip/flip.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

using Colour = std::array<double, 3>;

Image filled(int width, int height, float r, float g, float b) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        image.rgb[3 * i] = r;
        image.rgb[3 * i + 1] = g;
        image.rgb[3 * i + 2] = b;
    }
    return image;
}

/// Linear light of sRGB, then XYZ over that of white.
Colour relative_xyz(const Colour& linear) {
    const double m[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    Colour xyz{};
    for (int i = 0; i < 3; ++i) {
        const double* row = m[i];
        xyz[i] = (row[0] * linear[0] + row[1] * linear[1] + row[2] * linear[2]) /
                 (row[0] + row[1] + row[2]);
    }
    return xyz;
}

double to_linear(double v) {
    v = std::min(std::max(v, 0.0), 1.0);
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// The colour part of the publication (Sec. 4.1.2, 4.1.3) from relative XYZ.
double colour_error(const Colour& xyz_a, const Colour& xyz_b) {
    const auto lab = [](const Colour& xyz) {
        const auto f = [](double t) {
            return t > std::pow(6.0 / 29, 3) ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29;
        };
        const double l = 116 * f(xyz[1]) - 16;
        return Colour{l, 5 * l * (f(xyz[0]) - f(xyz[1])), 2 * l * (f(xyz[1]) - f(xyz[2]))};
    };
    const auto distance = [&](const Colour& a, const Colour& b) {
        const Colour p = lab(a);
        const Colour q = lab(b);
        return std::pow(std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]), 0.7);
    };
    const double most = distance(relative_xyz({0, 1, 0}), relative_xyz({0, 0, 1}));
    const double error = distance(xyz_a, xyz_b) / most;
    return error < 0.4 ? error * 0.95 / 0.4 : 0.95 + (error - 0.4) / 0.6 * 0.05;
}

/// FLIP pixel by pixel with filters in two dimensions, as the publication writes them, in double.
class Definition {
public:
    explicit Definition(double pixels_per_degree) : ppd_(pixels_per_degree) {}

    double mean(const Image& a, const Image& b) const {
        double sum = 0;
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x) {
                const double features =
                    std::max(std::abs(strength(a, x, y, 1) - strength(b, x, y, 1)),
                             std::abs(strength(a, x, y, 2) - strength(b, x, y, 2)));
                sum += std::pow(colour_error(seen(a, x, y), seen(b, x, y)),
                                1 - std::sqrt(features / std::sqrt(2.0)));
            }
        }
        return sum / static_cast<double>(a.pixels());
    }

private:
    using Weight = std::function<double(int, int)>;

    static Colour ycxcz(const Image& image, int x, int y) {
        x = std::min(std::max(x, 0), image.width - 1);
        y = std::min(std::max(y, 0), image.height - 1);
        const float* rgb = &image.rgb[3 * image.at(x, y)];
        const Colour xyz = relative_xyz({to_linear(rgb[0]), to_linear(rgb[1]), to_linear(rgb[2])});
        return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
    }
    /// Positive weights are scaled to sum 1, negative ones to -1.
    static double filtered(const Image& image, int x, int y, int channel, int radius,
                           const Weight& weight) {
        double up = 0, down = 0, sum_up = 0, sum_down = 0;
        for (int j = -radius; j <= radius; ++j) {
            for (int i = -radius; i <= radius; ++i) {
                const double w = weight(i, j);
                const double value = w * ycxcz(image, x + i, y + j)[channel];
                (w > 0 ? up : down) += value;
                (w > 0 ? sum_up : sum_down) += w;
            }
        }
        return up / sum_up - (sum_down < 0 ? down / sum_down : 0);
    }
    Colour seen(const Image& image, int x, int y) const {
        const int radius =
            static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd_));
        const auto sensitivity = [this](double a, double b) {
            return [=, ppd = ppd_](int i, int j) {
                return a * std::sqrt(kPi / b) *
                       std::exp(-kPi * kPi * (i * i + j * j) / (ppd * ppd) / b);
            };
        };
        const auto wide = sensitivity(34.1, 0.04);
        const auto narrow = sensitivity(13.5, 0.025);
        const double yy = filtered(image, x, y, 0, radius, sensitivity(1, 0.0047));
        const double cx = filtered(image, x, y, 1, radius, sensitivity(1, 0.0053));
        const double cz = filtered(image, x, y, 2, radius,
                                   [&](int i, int j) { return wide(i, j) + narrow(i, j); });
        // Back to linear light to limit it there, by solving relative_xyz for the colour.
        const double y1 = (yy + 16) / 116;
        return limited({y1 + cx / 500, y1, y1 - cz / 200});
    }
    /// Relative XYZ of the colour limited to 0 .. 1; Cramer's rule.
    static Colour limited(const Colour& xyz) {
        const Colour r = relative_xyz({1, 0, 0});
        const Colour g = relative_xyz({0, 1, 0});
        const Colour b = relative_xyz({0, 0, 1});
        const auto det = [](const Colour& p, const Colour& q, const Colour& s) {
            return p[0] * (q[1] * s[2] - q[2] * s[1]) - q[0] * (p[1] * s[2] - p[2] * s[1]) +
                   s[0] * (p[1] * q[2] - p[2] * q[1]);
        };
        const double whole = det(r, g, b);
        const auto limit = [](double v) { return std::min(std::max(v, 0.0), 1.0); };
        return relative_xyz({limit(det(xyz, g, b) / whole), limit(det(r, xyz, b) / whole),
                             limit(det(r, g, xyz) / whole)});
    }
    /// Length of the gradient of luma (order 1), or of its second derivatives (order 2).
    double strength(const Image& image, int x, int y, int order) const {
        const double sigma = 0.5 * 0.082 * ppd_;
        const int radius = static_cast<int>(std::ceil(3 * sigma));
        const auto bell = [&](int i, int j) {
            return std::exp(-(i * i + j * j) / (2 * sigma * sigma));
        };
        const auto along = [&](int i) {
            return order == 1 ? -i * 1.0 : i * i / (sigma * sigma) - 1;
        };
        const double across =
            filtered(image, x, y, 0, radius, [&](int i, int j) { return along(i) * bell(i, j); });
        const double down =
            filtered(image, x, y, 0, radius, [&](int i, int j) { return along(j) * bell(i, j); });
        return std::hypot(across, down) / 116;
    }
    double ppd_;
};

Image random_image(int width, int height, std::mt19937& random) {
    std::uniform_real_distribution<float> value(-0.1F, 1.1F);
    Image image(width, height);
    for (float& each : image.rgb) {
        each = value(random);
    }
    return image;
}

// Separated, streamed and in float: the filters sum up to 441 values of up to 100, each rounded to
// 2^-24 of itself, and the square root of the feature difference makes 1e-5 of them 3e-3 at most.
TEST(Flip, IsItsDefinition) {
    std::mt19937 random(7);
    for (const double ppd : {67.0206, 30.0}) {
        for (const auto& [width, height] : {std::pair(27, 14), std::pair(5, 33), std::pair(1, 1)}) {
            const Image a = random_image(width, height, random);
            Image b = a;
            for (std::size_t i = 0; i < b.rgb.size(); i += 7) {
                b.rgb[i] += 0.2F;
            }
            const double expected = Definition(ppd).mean(a, b);
            EXPECT_GT(expected, 0.01);
            EXPECT_NEAR(flip_difference(a, b, ppd), expected, 1e-3) << width << 'x' << height;
            EXPECT_NEAR(flip_difference(b, a, ppd), flip_difference(a, b, ppd), 1e-9);
        }
    }
}

// Without features only colours are compared: black and white, and two greys by CIELAB itself. 42
// sums in float lose up to 2.5e-4 of the 50 or 100 by which lightness differs.
TEST(Flip, ComparesPlainColours) {
    const auto plain = [](float a, float b) {
        return flip_difference(filled(20, 12, a, a, a), filled(20, 12, b, b, b));
    };
    const auto grey = [](double v) {
        const double light = to_linear(v);
        return relative_xyz({light, light, light});
    };
    EXPECT_NEAR(plain(0, 1), colour_error(grey(0), grey(1)), 1e-4);
    EXPECT_NEAR(plain(0.5F, 0.25F), colour_error(grey(0.5), grey(0.25)), 1e-4);
    EXPECT_NEAR(flip_difference(filled(9, 9, 0, 1, 0), filled(9, 9, 0, 0, 1)), 1.0, 1e-5);
}

TEST(Flip, SeesWhatAScreenShows) {
    const Image black = filled(16, 16, 0, 0, 0);
    EXPECT_EQ(flip_difference(black, black), 0.0);
    EXPECT_EQ(flip_difference(filled(16, 16, 1, 1, 1), filled(16, 16, 5, 1, 1.5F)), 0.0);
    EXPECT_EQ(flip_difference(black, filled(16, 16, -1, 0, 0)), 0.0);
    // A fine pattern fades into grey of the same light when its pixels become small.
    const Image grey = filled(48, 48, 0.7354F, 0.7354F, 0.7354F);
    Image pattern = filled(48, 48, 1, 1, 1);
    for (std::size_t i = 0; i < pattern.rgb.size(); ++i) {
        pattern.rgb[i] = (i / 3 / 48 + i / 3) % 2 == 0 ? 1.0F : 0.0F;
    }
    EXPECT_GT(flip_difference(grey, pattern, 15), 2 * flip_difference(grey, pattern, 67));
}

TEST(Flip, RefusesWhatCannotBeCompared) {
    EXPECT_THROW(flip_difference(Image(3, 4), Image(4, 3)), InputError);
    EXPECT_THROW(flip_difference(Image(0, 4), Image(0, 4)), InputError);
    Image broken(8, 8);
    broken.rgb[30] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(flip_difference(Image(8, 8), broken)));
}

} // namespace
} // namespace degs
