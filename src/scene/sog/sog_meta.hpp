// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace degs {

/// meta.json of a SOG scene, version 1 or 2, with every code turned into the value that it means.
struct SogMeta {
    using ByteTable = std::array<float, 256>;

    std::uint64_t count = 0;           ///< Gaussians
    glm::dvec3 low{0.0}, high{0.0};    ///< sign(x) ln(|x| + 1) of positions, per axis
    std::array<ByteTable, 3> scale{};  ///< log scale by axis and byte
    std::array<ByteTable, 3> colour{}; ///< coefficient of degree 0 by channel and byte
    ByteTable opacity{};               ///< linear, 0..1
    bool logits = false;               ///< the file has logits of opacities, as version 1
    ByteTable rest{};                  ///< higher coefficients
    int degree = 0;                    ///< 0..3; of version 1 it follows from the images: -1
    std::uint64_t palette = 0;         ///< entries; of version 1 as many as the image has
    bool antialiased = false;          ///< as older files say it
    std::string model = "default";     ///< as splat-transform says it; see take_render_model()
    /// Names of the images: means low and high bytes, scales, quats, sh0, and of degree 1 and more
    /// centroids and labels.
    std::string means_low, means_high, scales, quats, sh0, centroids, labels;
};

/// InputError "<where>: ..." for text that is no such file.
SogMeta parse_sog_meta(const std::string& where, const std::string& text);

} // namespace degs
