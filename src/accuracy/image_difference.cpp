// SPDX-License-Identifier: Apache-2.0
#include "accuracy/image_difference.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"

namespace degs {

void ImageDifference::add(const Image& reference, const Image& test, int x, int y) {
    pixels_ += reference.pixels();
    for (std::size_t i = 0; i < reference.pixels(); ++i) {
        const double worst = errors_.worst();
        const double error = errors_.add(reference, test, i);
        if (PixelErrors::is_worse(error, worst)) {
            worst_x_ = x + static_cast<int>(i) % reference.width;
            worst_y_ = y + static_cast<int>(i) / reference.width;
        }
        const double alpha =
            std::abs(static_cast<double>(reference.transmittance[i]) - test.transmittance[i]);
        alpha_sum_ += alpha;
        alpha_max_ = PixelErrors::is_worse(alpha, alpha_max_) ? alpha : alpha_max_;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            nonfinite_ += std::isfinite(test.rgb[c]) ? 0 : 1;
        }
        nonfinite_ += std::isfinite(test.transmittance[i]) ? 0 : 1;
        recounted_ += reference.fragments[i] != test.fragments[i] ? 1 : 0;
    }
}

double ImageDifference::alpha_error_mean() const {
    return mean_of(alpha_sum_, pixels_);
}

double ImageDifference::psnr_db() const {
    return errors_.psnr_db(pixels_);
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
