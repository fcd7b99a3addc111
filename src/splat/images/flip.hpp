// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/images/image.hpp"

namespace degs {

/// How large a viewer sees a pixel: 67 per degree is a screen of 3840 px and 0.7 m at 0.7 m, as the
/// publication assumes.
constexpr double kPixelsPerDegree = 67.0206;

/// Mean difference of two images as seen by someone who flips between them, 0 (none) .. 1: LDR-FLIP
/// (P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020), from the
/// publication. Colours are taken as sRGB and limited to 0 .. 1, because a screen limits them.
/// Borders repeat the outermost pixel. A value that is no number makes the result one, too.
/// InputError if sizes differ or there is no pixel.
double flip_difference(const Image& reference, const Image& test,
                       double pixels_per_degree = kPixelsPerDegree);

} // namespace degs
