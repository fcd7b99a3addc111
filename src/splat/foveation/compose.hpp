// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/foveation/foveation.hpp"
#include "splat/images/image.hpp"

namespace degs {

/// The image of a camera from those of its levels: pixels of the finest level that shows them, as
/// they are at scale 1, and bilinear between the centres of coarser pixels; their `fragments` are
/// those of the nearest one. In double, rounded once. `images` have the sizes of the levels'
/// cameras.
Image compose(const Camera& camera, const std::vector<FoveatedLevel>& levels,
              const std::vector<const Image*>& images);

/// For each pixel of the image, row by row: which of the levels shows it.
std::vector<unsigned char> shown_levels(const Camera& camera,
                                        const std::vector<FoveatedLevel>& levels);

} // namespace degs
