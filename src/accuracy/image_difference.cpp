// SPDX-License-Identifier: Apache-2.0
#include "accuracy/image_difference.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"

namespace degs {

void ImageDifference::add(const Image& reference, const Image& test, int x, int y) {
    pixels_ += reference.pixels();
    for (std::size_t i = 0; i < reference.pixels(); ++i) {
        double error = 0;
        std::uint64_t nonfinite = 0;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const double wanted = reference.rgb[c];
            const double distance = std::abs(wanted - test.rgb[c]);
            if (std::isfinite(distance)) {
                squares_ += distance * distance;
                error = std::max(error, distance);
            } else {
                ++nonfinite;
            }
        }
        const double alpha =
            std::abs(static_cast<double>(reference.transmittance[i]) - test.transmittance[i]);
        if (std::isfinite(alpha)) {
            alpha_sum_ += alpha;
            alpha_max_ = std::max(alpha_max_, alpha);
        } else {
            ++nonfinite;
        }
        if ((nonfinite > 0 && nonfinite_ == 0) || (error > worst_ && nonfinite_ == 0)) {
            worst_x_ = x + static_cast<int>(i) % reference.width;
            worst_y_ = y + static_cast<int>(i) / reference.width;
        }
        worst_ = std::max(worst_, error);
        nonfinite_ += nonfinite;
        recounted_ += reference.fragments[i] != test.fragments[i] ? 1 : 0;
    }
}

double ImageDifference::alpha_error_mean() const {
    return mean_of(alpha_sum_, pixels_);
}

double ImageDifference::psnr_db() const {
    return -10 * std::log10(mean_of(squares_, 3 * pixels_));
}

void subtract(const Image& reference, Image& test) {
    for (std::size_t i = 0; i < test.rgb.size(); ++i) {
        test.rgb[i] -= reference.rgb[i];
    }
    for (std::size_t i = 0; i < test.pixels(); ++i) {
        test.transmittance[i] -= reference.transmittance[i];
        const auto [fewer, more] = std::minmax(test.fragments[i], reference.fragments[i]);
        test.fragments[i] = more - fewer;
    }
}

} // namespace degs
