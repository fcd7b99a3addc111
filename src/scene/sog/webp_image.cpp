// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/webp_image.hpp"

#include <webp/decode.h>

#include "base/visible_text.hpp"
#include "scene/files/input_file.hpp"

namespace degs {

RgbaImage decode_webp(const std::string& where, const std::string& name, const std::string& file,
                      std::uint64_t limit_pixels) {
    const std::string called = "its image '" + visible(name.substr(0, 100)) + "' ";
    const auto* const data = reinterpret_cast<const std::uint8_t*>(file.data());
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(data, file.size(), &features) != VP8_STATUS_OK ||
        features.has_animation != 0 || features.width < 1 || features.height < 1) {
        fail_file(where, called + "is no still WebP image.");
    }
    RgbaImage image;
    image.width = features.width;
    image.height = features.height;
    constexpr int kLossless = 2;
    image.lossy = features.format != kLossless;
    if (image.pixels() > limit_pixels) {
        fail_file(where, called + "has " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels, more than the " +
                             std::to_string(limit_pixels) + " allowed for it.");
    }
    image.bytes.resize(4 * image.pixels());
    if (WebPDecodeRGBAInto(data, file.size(), image.bytes.data(), image.bytes.size(),
                           4 * image.width) == nullptr) {
        fail_file(where, called + "cannot be decoded; the file is truncated or damaged.");
    }
    return image;
}

} // namespace degs
