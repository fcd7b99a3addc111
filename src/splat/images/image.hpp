// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace degs {

/// A rendered frame: colour in the scene's display-referred space (not clamped), the transmittance
/// left for the background, and how many splats each pixel blended. Row-major from the top left.
/// A colour value as a byte, wherever one is written: PNG files, frame buffers, checksums. 0..1
/// becomes 0..255, to the nearest step in single precision, halves up; NaN is 0.
inline std::uint8_t byte_of(float value) {
    const float clamped = std::min(std::max(0.0F, value), 1.0F);
    return static_cast<std::uint8_t>(clamped * 255.0F + 0.5F);
}

struct Image {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;               ///< 3 per pixel
    std::vector<float> transmittance;     ///< 1 per pixel, 1 = nothing drawn
    std::vector<std::uint32_t> fragments; ///< pixel updates performed (blended splats), 1 per pixel

    Image() = default;
    Image(int w, int h)
        : width(w), height(h), rgb(pixels() * 3, 0.0F), transmittance(pixels(), 1.0F),
          fragments(pixels(), 0) {}
    std::size_t pixels() const { return std::size_t{1} * width * height; }
    std::size_t at(int x, int y) const { return std::size_t{1} * y * width + x; }
    /// Writes pixel i, rounded to single precision; `colour` are its three channels.
    void put(std::size_t i, const double* colour, double transmitted, std::uint32_t blended) {
        std::transform(colour, colour + 3, &rgb[3 * i],
                       [](double c) { return static_cast<float>(c); });
        transmittance[i] = static_cast<float>(transmitted);
        fragments[i] = blended;
    }
};

} // namespace degs
