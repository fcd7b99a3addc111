// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/images/image.hpp"

namespace degs {

struct ImageError {
    double psnr_db = 0; ///< peak 1, one MSE over all pixels and channels of the unclamped float
                        ///< images; +infinity if identical
    double ssim = 0;    ///< 11x11 Gaussian window, sigma 1.5, zero padding, mean over channels
    double max_abs_error = 0; ///< of a channel or a transmittance, see PixelErrors
};

/// The errors of pixels, summed. Results of all commands are of this one definition: an infinite
/// error is larger than all others, and what is not a number is larger than that, so that neither
/// is hidden.
class PixelErrors {
public:
    /// Adds a pixel of two images of one size, and returns the largest difference of its channels
    /// and its transmittance.
    double add(const Image& reference, const Image& test, std::size_t pixel);
    /// The PSNR of the unclamped colours with peak 1, dB; +infinity if all of them are equal.
    double psnr_db(std::size_t pixels) const;
    double worst() const { return worst_; }
    static bool is_worse(double error, double than);

private:
    double squares_ = 0, worst_ = 0;
};

/// Throws InputError if sizes differ or the images are empty.
void check_comparable(const Image& reference, const Image& test);

/// Compares two images; accumulates in double. A non-finite pixel makes the numbers it enters NaN
/// or infinite. Throws InputError as check_comparable().
ImageError compare_images(const Image& reference, const Image& test);

} // namespace degs
