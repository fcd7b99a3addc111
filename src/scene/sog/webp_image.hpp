// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace degs {

/// Pixels of 4 bytes, r g b a, row by row from the top left.
struct RgbaImage {
    int width = 0, height = 0;
    bool lossy = false; ///< the codec changed the bytes
    std::vector<unsigned char> bytes;

    std::uint64_t pixels() const { return std::uint64_t{1} * width * height; }
};

/// Decodes a WebP image. InputError "<where>: ..." that calls it `name` if it is none or has more
/// than `limit_pixels`; this is checked before anything is allocated.
RgbaImage decode_webp(const std::string& where, const std::string& name, const std::string& file,
                      std::uint64_t limit_pixels);

} // namespace degs
