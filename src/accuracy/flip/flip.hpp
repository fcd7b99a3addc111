// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/images/image.hpp"

namespace degs {

/// Pixels per degree of the viewer's field of view: 67 is a screen of 3840 px and 0.7 m at 0.7 m,
/// as the publication assumes.
constexpr double kPixelsPerDegree = 67.0206;

/// Mean difference of two images as seen by someone who flips between them, 0 (none) .. 1: LDR-FLIP
/// (P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020), from the
/// publication. Colours are taken as sRGB and limited to 0 .. 1, because a screen limits them.
/// Borders repeat the outermost pixel. A NaN in an image makes the result NaN. Throws InputError if
/// sizes differ or the images are empty.
double flip_difference(const Image& reference, const Image& test,
                       double pixels_per_degree = kPixelsPerDegree);
/// The differences of which that is the mean, of each pixel row by row.
std::vector<double> flip_map(const Image& reference, const Image& test,
                             double pixels_per_degree = kPixelsPerDegree);

} // namespace degs
