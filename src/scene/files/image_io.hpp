// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "splat/images/image.hpp"

namespace degs {

/// Largest width and height of an image in pixels: what libpng writes (PNG_USER_WIDTH_MAX).
constexpr int kMostImageSide = 1000000;

/// Writes an OpenEXR file: float channels R, G, B as they are (display-referred; the attribute
/// `colorSpace` says "srgb_rec709_display"), float `transmittance` and uint `fragments`. Values
/// need not be finite. Like write_png(), it writes the file whole or not at all, and throws
/// InputError if the place cannot be written.
void write_exr(const Image& image, const std::string& path);

/// A channel of its own, row by row; values need not be finite.
struct ExrLayer {
    std::string name;
    const float* values;
};
/// Writes float channels of these names, for what is not a picture; likewise whole or not at all.
void write_exr(const std::vector<ExrLayer>& layers, int width, int height, const std::string& path);

/// Reads R, G, B and, where present, `transmittance` and `fragments` (else 1 and 0). Throws
/// InputError if this is not an EXR image of at most 2^28 pixels with these channels.
Image read_exr(const std::string& path);

/// Writes 8 bits per channel: clamp(value, 0, 1) * 255 + 0.5, truncated; NaN is 0. No gamma: the
/// values are display-referred already.
void write_png(const Image& image, const std::string& path);

/// CRC-32 (that of zlib and PNG) of the bytes that write_png() stores: rows from the top, red,
/// green, blue. Eight hexadecimal digits, all 0 if the image has no pixels.
std::string pixel_crc32(const Image& image);

} // namespace degs
