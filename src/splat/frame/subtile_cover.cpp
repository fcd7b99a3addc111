// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/subtile_cover.hpp"

#include <cmath>

namespace degs {

OrientedBox::OrientedBox(const ProjectedSplat& splat) : mu_x_(splat.mu_x), mu_y_(splat.mu_y) {
    const double half_difference = 0.5 * (splat.cov_a - splat.cov_c);
    const double root = std::hypot(half_difference, splat.cov_b);
    const double largest = 0.5 * (splat.cov_a + splat.cov_c) + root;
    // The other eigenvalue is det / largest, because mid - root loses all digits for needles.
    major_ = std::sqrt(splat.q_end() * largest);
    minor_ = std::sqrt(splat.q_end() * (splat.det / largest));
    if (root > 0) {
        // Half-angle formulas by the larger of the two, the smaller from sin 2t = 2 sin t cos t.
        const double sine_of_double = splat.cov_b / root;
        const double larger = std::sqrt(0.5 + 0.5 * std::abs(half_difference) / root);
        const double smaller = 0.5 * sine_of_double / larger;
        cosine_ = half_difference >= 0 ? larger : smaller;
        sine_ = half_difference >= 0 ? smaller : larger;
    }
    reach_x_ = major_ * std::abs(cosine_) + minor_ * std::abs(sine_);
    reach_y_ = major_ * std::abs(sine_) + minor_ * std::abs(cosine_);
}

bool OrientedBox::meets(double x, double y, double size) const {
    const double half = 0.5 * size;
    const double dx = x + half - 0.5 - mu_x_;
    const double dy = y + half - 0.5 - mu_y_;
    const double slack =
        pixel_slack(std::abs(dx) + std::abs(dy) + std::abs(mu_x_) + std::abs(mu_y_) + major_);
    if (std::abs(dx) > half + reach_x_ + slack || std::abs(dy) > half + reach_y_ + slack) {
        return false;
    }
    const double shadow = half * (std::abs(cosine_) + std::abs(sine_)) + slack;
    return std::abs(dx * cosine_ + dy * sine_) <= major_ + shadow &&
           std::abs(dy * cosine_ - dx * sine_) <= minor_ + shadow;
}

SubtileGrid::SubtileGrid(int tile_size, int side) : side_(side), per_side_(tile_size / side) {}

SubtileMask SubtileGrid::holding(const PixelRange& columns, const PixelRange& rows) const {
    SubtileMask mask = 0;
    for (int row = rows.first / side_; row <= rows.last / side_; ++row) {
        mask |= of_pixels(row * side_, columns);
    }
    return mask;
}

SubtileMask SubtileGrid::meeting(const OrientedBox& box, int x, int y, SubtileMask among) const {
    SubtileMask mask = 0;
    for (int row = 0, s = 0; row < per_side_; ++row) {
        for (int column = 0; column < per_side_; ++column, ++s) {
            const SubtileMask bit = SubtileMask{1} << s;
            if ((among & bit) != 0 && box.meets(x + column * side_, y + row * side_, side_)) {
                mask |= bit;
            }
        }
    }
    return mask;
}

SubtileMask SubtileGrid::of_pixels(int row, const PixelRange& columns) const {
    const int row_begin = row / side_ * per_side_;
    const auto below = [](int bit) { return (SubtileMask{1} << bit) - 1; };
    const SubtileMask up_to_last = below(row_begin + columns.last / side_) * 2 + 1;
    return up_to_last & ~below(row_begin + columns.first / side_);
}

} // namespace degs
