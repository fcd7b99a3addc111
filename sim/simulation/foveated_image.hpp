// SPDX-License-Identifier: Apache-2.0
// A foveated image: what its levels make up, and how far it is from a full one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/view/foveated_view.hpp"
#include "splat/images/image.hpp"
#include "splat/images/image_metrics.hpp"

namespace degs::sim {

/// How far some pixels of an image are from those of the reference at full resolution.
struct PartError {
    double psnr_db = 0; ///< as in ImageError
    double flip = 0;    ///< mean of flip_map() over the pixels
};

struct FoveatedImage {
    FoveatedView view;
    std::vector<std::uint64_t> shown; ///< pixels of the image that each level shows
    Image image;                      ///< composed
    std::optional<ImageError> error;  ///< against references of the levels, composed likewise
    std::vector<PartError> parts;     ///< of what each level shows; empty without a reference
    std::optional<PartError> whole;   ///< of the image; likewise
};

struct FoveationFacts {
    Foveation asked;
    std::vector<FoveatedImage> images; ///< of the first frame
};

/// Composes an image from those of its levels; nothing is compared.
FoveatedImage foveated_image(const FoveatedView& view, const std::vector<const Image*>& levels);
/// Compares it with the references of its levels and with the one at full resolution.
void judge(FoveatedImage& image, const std::vector<const Image*>& levels, const Image& full);

} // namespace degs::sim
