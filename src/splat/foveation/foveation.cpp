// SPDX-License-Identifier: Apache-2.0
#include "splat/foveation/foveation.hpp"

#include <algorithm>
#include <cmath>

#include "splat/foveation/coarse_samples.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

constexpr int kMiddleScale = 2, kRimScale = 4;

struct Ends {
    int first, last;
};

/// Pixels of a side of the image within `reach` px of `centre`, at least one.
Ends pixels_within(double centre, double reach, int side) {
    const double most = side - 1;
    const double first = std::clamp(std::floor(centre - reach), 0.0, most);
    const double last = std::clamp(std::ceil(centre + reach) - 1, first, most);
    return {static_cast<int>(first), static_cast<int>(last)};
}

PixelBox around(const Camera& camera, const glm::dvec2& centre, double degrees) {
    const double slope = std::tan(degrees * kDegree);
    const Ends x = pixels_within(centre.x * camera.width, camera.fx * slope, camera.width);
    const Ends y = pixels_within(centre.y * camera.height, camera.fy * slope, camera.height);
    return {x.first, y.first, x.last, y.last};
}

/// Samples of which pixels first .. last are made.
Ends samples_for(const Ends& pixels, int scale, int samples) {
    return {samples_at(pixels.first, scale, samples).low,
            samples_at(pixels.last, scale, samples).high};
}

/// Samples of which no pixel outside of first .. last is made.
Ends samples_inside(const Ends& pixels, int side, int scale, int samples) {
    return {pixels.first == 0 ? 0 : samples_at(pixels.first - 1, scale, samples).high + 1,
            pixels.last == side - 1 ? samples - 1
                                    : samples_at(pixels.last + 1, scale, samples).low - 1};
}

FoveatedLevel coarse_level(const Camera& camera, int scale, const PixelBox& shown,
                           const PixelBox& finer) {
    const Camera whole = camera.coarsened(scale);
    const Ends x = samples_for({shown.x0, shown.x1}, scale, whole.width);
    const Ends y = samples_for({shown.y0, shown.y1}, scale, whole.height);
    const Ends hole_x = samples_inside({finer.x0, finer.x1}, camera.width, scale, whole.width);
    const Ends hole_y = samples_inside({finer.y0, finer.y1}, camera.height, scale, whole.height);
    FoveatedLevel level{scale, shown, {x.first, y.first}, whole};
    if (x.first > 0 || y.first > 0 || x.last < whole.width - 1 || y.last < whole.height - 1) {
        level.camera = whole.cropped({x.first, y.first, x.last, y.last});
    }
    const PixelBox hole{hole_x.first, hole_y.first, hole_x.last, hole_y.last};
    if (!hole.empty()) {
        level.camera.hole = hole.relative_to(-whole.origin.x, -whole.origin.y);
    }
    return level;
}

} // namespace

std::vector<FoveatedLevel> levels_of(const Camera& camera, const Foveation& foveation) {
    const PixelBox all{0, 0, camera.width - 1, camera.height - 1};
    const PixelBox fovea = around(camera, foveation.centre, foveation.fovea);
    const PixelBox middle = around(camera, foveation.centre, foveation.periphery);
    std::vector<FoveatedLevel> levels{
        {1, fovea, {fovea.x0, fovea.y0}, fovea == all ? camera : camera.cropped(fovea)}};
    if (middle != fovea) {
        levels.push_back(coarse_level(camera, kMiddleScale, middle, fovea));
    }
    if (middle != all) {
        levels.push_back(coarse_level(camera, kRimScale, all, middle));
    }
    return levels;
}

} // namespace degs
