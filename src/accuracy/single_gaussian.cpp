// SPDX-License-Identifier: Apache-2.0
#include "accuracy/single_gaussian.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"
#include "splat/frame/pixel_index.hpp"
#include "splat/frame/pixel_rules.hpp"

namespace degs {
namespace {

constexpr double kLog2e = 1.4426950408889634;

/// 0 .. 1, the same on every machine: the engine's bits are fixed by the standard, its
/// distributions are not.
double unit(std::mt19937_64& random) {
    return std::ldexp(random() >> 11, -53);
}
double between(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * unit(random);
}

} // namespace

AlphaMap direct_alpha(const ProjectedSplat& splat, WindowCorner corner,
                      const NumberFormat& format) {
    const Rounder r(format);
    const double mu_x = r(splat.mu_x);
    const double mu_y = r(splat.mu_y);
    const double a = r(splat.conic_a());
    const double b = r(splat.conic_b());
    const double c = r(splat.conic_c());
    const double opacity = r(splat.opacity);
    const double log2e = r(kLog2e);
    AlphaMap map;
    for (int j = 0; j < kAlphaWindow; ++j) {
        const double dy = r(mu_y - (corner.y + j));
        const double vertical = r(r(c * dy) * dy);
        for (int i = 0; i < kAlphaWindow; ++i) {
            const double dx = r(mu_x - (corner.x + i));
            const double squares = r(r(r(a * dx) * dx) + vertical);
            const double power = r(r(-0.5 * squares) - r(r(b * dx) * dy));
            // Units for FP16 compute 2^x; exp(x) costs them a product with their log2 e.
            const double alpha = r(opacity * r(std::exp2(r(power * log2e))));
            map.at(i, j) = alpha < kAlphaMin ? 0.0 : std::min(r(kAlphaMax), alpha);
        }
    }
    return map;
}

AlphaMap row_alpha(const ProjectedSplat& splat, WindowCorner corner, const QuantizedRow& path) {
    const QuantizedSplat record = path.record(splat);
    AlphaMap map;
    for (int j = 0; j < kAlphaWindow; ++j) {
        const QuantizedSpan span =
            path.solve(record, corner.y + j, corner.x, corner.x + kAlphaWindow);
        for (int x = span.x0; x <= span.x1; ++x) {
            const double q = path.q(record.a, span.g0, span.d0, x - span.base);
            map.at(x - corner.x, j) = path.alpha(record, q);
        }
    }
    return map;
}

void AlphaError::add(const AlphaMap& reference, const AlphaMap& map) {
    double sum = 0;
    for (std::size_t i = 0; i < map.alpha.size(); ++i) {
        const double expected = reference.alpha[i];
        const double difference = std::abs(map.alpha[i] - expected);
        support += expected > 0;
        if (!std::isfinite(difference)) {
            ++nonfinite;
            continue;
        }
        const bool flip = (expected > 0) != (map.alpha[i] > 0);
        flips += flip;
        max = flip ? max : std::max(max, difference);
        sum += difference;
    }
    ++gaussians;
    means.push_back(mean_of(sum, map.alpha.size()));
}

double AlphaError::mean() const {
    double sum = 0;
    for (const double each : means) {
        sum += each;
    }
    return mean_of(sum, means.size());
}

double AlphaError::spread() const {
    const double centre = mean();
    double sum = 0;
    for (const double each : means) {
        sum += (each - centre) * (each - centre);
    }
    return std::sqrt(mean_of(sum, means.size()));
}

ProjectedSplat window_splat(double x, double y, double major, double minor, double angle,
                            double opacity) {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const double along = major * major;
    const double across = minor * minor;
    ProjectedSplat splat;
    splat.mu_x = x;
    splat.mu_y = y;
    splat.cov_a = along * cosine * cosine + across * sine * sine;
    splat.cov_b = (along - across) * cosine * sine;
    splat.cov_c = along * sine * sine + across * cosine * cosine;
    splat.det = along * across;
    splat.opacity = opacity;
    splat.q_threshold = 2 * std::log(opacity / kAlphaMin);
    splat.depth = 1;
    return splat;
}

ProjectedSplat isotropic_splat(std::mt19937_64& random) {
    constexpr double middle = 0.5 * kAlphaWindow;
    const double x = between(random, middle - 1, middle);
    const double y = between(random, middle - 1, middle);
    return window_splat(x, y, 3, 3, 0, 1);
}

ProjectedSplat random_window_splat(std::mt19937_64& random) {
    const double major = std::pow(12.0, unit(random));
    const double minor = major / between(random, 1, std::min(6.0, major));
    const double x = between(random, 0.25, 0.75) * kAlphaWindow;
    const double y = between(random, 0.25, 0.75) * kAlphaWindow;
    const double angle = between(random, 0, 2 * std::acos(-1.0));
    return window_splat(x, y, major, minor, angle, between(random, 0.1, 1));
}

WindowCorner window_of(const ProjectedSplat& splat, const PixelBox& image) {
    const auto corner = [](double mean, int first, int last) {
        const int first_window = first / kAlphaWindow;
        const int last_window = last / kAlphaWindow;
        return kAlphaWindow *
               index_within(std::floor(mean / kAlphaWindow), first_window, last_window);
    };
    return {corner(splat.mu_x, image.x0, image.x1), corner(splat.mu_y, image.y0, image.y1)};
}

} // namespace degs
