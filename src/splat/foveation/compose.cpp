// SPDX-License-Identifier: Apache-2.0
#include "splat/foveation/compose.hpp"

#include <array>

#include "base/parallel.hpp"
#include "splat/foveation/coarse_samples.hpp"

namespace degs {
namespace {

/// One pixel at a time, from a view's image.
class Sampler {
public:
    Sampler(const Camera& camera, const FoveatedLevel& level, const Image& image)
        : level_(level), image_(image), samples_((camera.width + level.scale - 1) / level.scale,
                                                 (camera.height + level.scale - 1) / level.scale) {}

    void copy(int x, int y, Image& to, std::size_t at) const {
        const CoarseSamples column = samples_at(x, level_.scale, samples_.x);
        const CoarseSamples row = samples_at(y, level_.scale, samples_.y);
        const std::array<std::size_t, 4> from{
            place(column.low, row.low), place(column.high, row.low), place(column.low, row.high),
            place(column.high, row.high)};
        const auto between = [&](const auto& value) {
            const double above = mix(value(from[0]), value(from[1]), column.share);
            const double below = mix(value(from[2]), value(from[3]), column.share);
            return mix(above, below, row.share);
        };
        std::array<double, 3> colour{};
        for (std::size_t c = 0; c < 3; ++c) {
            colour[c] = between([&](std::size_t i) { return image_.rgb[3 * i + c]; });
        }
        const double left = between([&](std::size_t i) { return image_.transmittance[i]; });
        to.put(at, colour.data(), left,
               image_.fragments[place(x / level_.scale, y / level_.scale)]);
    }

private:
    static double mix(double low, double high, double share) {
        return (1 - share) * low + share * high;
    }
    std::size_t place(int x, int y) const {
        return image_.at(x - level_.first.x, y - level_.first.y);
    }

    const FoveatedLevel& level_;
    const Image& image_;
    glm::ivec2 samples_; ///< of the whole image
};

void copy_pixel(const Image& from, int x, int y, Image& to, std::size_t at) {
    const std::size_t i = from.at(x, y);
    std::copy_n(&from.rgb[3 * i], 3, &to.rgb[3 * at]);
    to.transmittance[at] = from.transmittance[i];
    to.fragments[at] = from.fragments[i];
}

} // namespace

std::vector<unsigned char> shown_levels(const Camera& camera,
                                        const std::vector<FoveatedLevel>& levels) {
    std::vector<unsigned char> shown(camera.pixels());
    for (std::size_t l = levels.size(); l-- > 0;) { // finer ones over coarser ones
        const PixelBox& box = levels[l].shown;
        for (int y = box.y0; y <= box.y1; ++y) {
            const auto row = shown.begin() + std::ptrdiff_t{1} * y * camera.width;
            std::fill(row + box.x0, row + box.x1 + 1, static_cast<unsigned char>(l));
        }
    }
    return shown;
}

Image compose(const Camera& camera, const std::vector<FoveatedLevel>& levels,
              const std::vector<const Image*>& images) {
    Image image(camera.width, camera.height);
    const std::vector<unsigned char> shown = shown_levels(camera, levels);
    std::vector<Sampler> samplers;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        samplers.emplace_back(camera, levels[l], *images[l]);
    }
    parallel_blocks(camera.height, [&](std::size_t row, std::size_t) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < camera.width; ++x) {
            const std::size_t at = image.at(x, y);
            const FoveatedLevel& level = levels[shown[at]];
            if (level.scale == 1) {
                copy_pixel(*images[shown[at]], x - level.first.x, y - level.first.y, image, at);
            } else {
                samplers[shown[at]].copy(x, y, image, at);
            }
        }
    });
    return image;
}

} // namespace degs
