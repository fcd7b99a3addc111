// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/images/image.hpp"

namespace degs {

struct ImageError {
    double psnr_db = 0; ///< peak 1, one MSE over all pixels and channels of the unclamped float
                        ///< images; +infinity if identical
    double ssim = 0;    ///< 11x11 Gaussian window, sigma 1.5, zero padding, mean over channels
    double max_abs_error = 0; ///< largest channel difference
};

/// Throws InputError if sizes differ or the images are empty.
void check_comparable(const Image& reference, const Image& test);

/// Compares the colours of two images; accumulates in double. A non-finite pixel makes the numbers
/// it enters NaN or infinite. Throws InputError as check_comparable().
ImageError compare_images(const Image& reference, const Image& test);

} // namespace degs
