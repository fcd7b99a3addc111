// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "splat/images/image_metrics.hpp"

namespace degs {

/// How far images of a frame are from their reference, pixel by pixel, summed over any number of
/// parts of the frame. alpha of a pixel is 1 - its transmittance.
class ImageDifference {
public:
    /// Adds images of one size whose first pixel is (x, y) of the frame.
    void add(const Image& reference, const Image& test, int x = 0, int y = 0);

    std::uint64_t pixels() const { return pixels_; }
    double alpha_error_mean() const; ///< absolute, over all pixels
    double alpha_error_max() const { return alpha_max_; }
    /// PSNR of the unclamped colours with peak 1, dB; infinite if they are equal.
    double psnr_db() const;
    /// Largest difference of a channel or a transmittance, as in ImageError.
    double max_abs_error() const { return errors_.worst(); }
    /// Channels and transmittances of the test image that are infinite or not a number.
    std::uint64_t nonfinite() const { return nonfinite_; }
    /// Pixels that another number of splats updated than in the reference.
    std::uint64_t recounted() const { return recounted_; }
    bool identical() const { return errors_.worst() == 0; }

    /// The first pixel with the largest error, in the frame.
    int worst_x() const { return worst_x_; }
    int worst_y() const { return worst_y_; }

private:
    std::uint64_t pixels_ = 0, nonfinite_ = 0, recounted_ = 0;
    PixelErrors errors_;
    double alpha_sum_ = 0, alpha_max_ = 0;
    int worst_x_ = 0, worst_y_ = 0;
};

/// Turns `test` into test - reference: colours and transmittance signed, fragments their distance.
void subtract(const Image& reference, Image& test);

} // namespace degs
