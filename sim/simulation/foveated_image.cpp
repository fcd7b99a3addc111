// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/foveated_image.hpp"

#include <cmath>

#include "accuracy/flip/flip.hpp"
#include "base/ratio.hpp"
#include "sim/simulation/completed_run.hpp"
#include "sim/view/foveated_view.hpp"
#include "splat/foveation/compose.hpp"

namespace degs::sim {
namespace {

/// Sums over some pixels of two images.
struct Sums {
    double squares = 0, flip = 0;
    std::uint64_t pixels = 0;

    PartError error() const {
        return {-10 * std::log10(mean_of(squares, 3 * pixels)), mean_of(flip, pixels)};
    }
};

double squares_of(const Image& a, const Image& b, std::size_t pixel) {
    double sum = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
        const double difference = double{a.rgb[i]} - b.rgb[i];
        sum += difference * difference;
    }
    return sum;
}

} // namespace

FoveatedImage foveated_image(const FoveatedView& view, const std::vector<const Image*>& levels) {
    FoveatedImage image{view, {}, compose(view.camera, view.levels, levels), {}, {}, {}};
    image.shown.assign(view.levels.size(), 0);
    for (const unsigned char level : shown_levels(view.camera, view.levels)) {
        ++image.shown[level];
    }
    return image;
}

void judge(FoveatedImage& image, const std::vector<const Image*>& levels, const Image& full) {
    const FoveatedView& view = image.view;
    image.error = compare_images(compose(view.camera, view.levels, levels), image.image);
    const std::vector<double> flip = flip_map(full, image.image);
    const std::vector<unsigned char> shown = shown_levels(view.camera, view.levels);
    std::vector<Sums> parts(view.levels.size());
    Sums whole;
    for (std::size_t pixel = 0; pixel < shown.size(); ++pixel) {
        const double squares = squares_of(full, image.image, pixel);
        for (Sums* const sums : {&parts[shown[pixel]], &whole}) {
            sums->squares += squares;
            sums->flip += flip[pixel];
            ++sums->pixels;
        }
    }
    for (const Sums& sums : parts) {
        image.parts.push_back(sums.error());
    }
    image.whole = whole.error();
}

} // namespace degs::sim
