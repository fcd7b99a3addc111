// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "splat/frame/projection.hpp"

/// Projected splats made by hand, and a slow opinion on which pixels they cover.
namespace degs::test {

/// Ellipse with standard deviations `major` and `minor` (px), the major axis turned by `angle`.
inline ProjectedSplat make_splat(double x, double y, double major, double minor, double angle,
                                 double opacity) {
    const double l1 = major * major;
    const double l2 = minor * minor;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    ProjectedSplat s;
    s.mu_x = x;
    s.mu_y = y;
    s.cov_a = l1 * cosine * cosine + l2 * sine * sine;
    s.cov_b = (l1 - l2) * cosine * sine;
    s.cov_c = l1 * sine * sine + l2 * cosine * cosine;
    s.det = l1 * l2;
    s.opacity = opacity;
    s.q_threshold = 2 * std::log(opacity * 255);
    s.colour[0] = s.colour[1] = s.colour[2] = 1;
    s.depth = 1;
    return s;
}

/// Ends the splat at q = `at`, if it reaches further.
inline void cut(ProjectedSplat& s, double at) {
    s.q_cut_off = std::max(0.0, s.q_threshold - at);
    s.q_threshold = std::min(s.q_threshold, at);
}

/// q by the completed square of b, c and det in long double: what a splat means, also for needles,
/// whose a the other three determine better than the rounded a.
inline long double exact_q(const ProjectedSplat& s, long double x, long double y) {
    const long double dy = y - static_cast<long double>(s.mu_y);
    const long double c = s.cov_c;
    const long double along = x - static_cast<long double>(s.mu_x) - s.cov_b / c * dy;
    return c / static_cast<long double>(s.det) * along * along + dy * dy / c;
}

/// A splat of any shape near a tile of `size` px whose corner is (x0, y0); needles of aspect up to
/// 1e4 at every angle, and splats that are cut, among them.
inline ProjectedSplat random_splat(std::mt19937& random, double x0, double y0, double size) {
    std::uniform_real_distribution<double> unit(0, 1);
    const bool needle = unit(random) < 0.4;
    const double minor = std::sqrt(0.3) * std::exp(needle ? unit(random) : 3 * unit(random));
    const double aspect = std::exp((needle ? std::log(1e4) : std::log(8.0)) * unit(random));
    const double opacity = unit(random) < 0.2 ? 1.0 : 1.0 / 255 + (1 - 1.0 / 255) * unit(random);
    const double angle = unit(random) < 0.1 ? std::acos(-1.0) / 2 * std::floor(4 * unit(random))
                                            : 6.3 * unit(random);
    ProjectedSplat s =
        make_splat(x0 + size * (2 * unit(random) - 0.5), y0 + size * (2 * unit(random) - 0.5),
                   minor * aspect, minor, angle, opacity);
    if (unit(random) < 0.2) { // a long way off, but reaching for the tile
        const double way = minor * aspect * 2 * unit(random);
        s.mu_x += way * std::cos(angle);
        s.mu_y += way * std::sin(angle);
    }
    if (unit(random) < 0.2) {
        cut(s, 9 * unit(random));
    }
    return s;
}

} // namespace degs::test
