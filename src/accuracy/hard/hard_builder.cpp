// SPDX-License-Identifier: Apache-2.0
#include "accuracy/hard/hard_builder.hpp"

#include <cmath>

#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

constexpr double kFocal = 0.8; ///< widths
constexpr double kFlat = 1e-9; ///< scene units

} // namespace

HardBuilder::HardBuilder(int width, int height) {
    scene.camera.width = width;
    scene.camera.height = height;
    scene.camera.fx = scene.camera.fy = kFocal * width;
}

void HardBuilder::add(const ScreenSplat& splat) {
    const Camera& camera = scene.camera;
    const double pixel = splat.depth / camera.fx; // scene units
    const glm::dvec3 mean((splat.x - 0.5 * width() + 0.5) * pixel,
                          (splat.y - 0.5 * height() + 0.5) * pixel, splat.depth);
    add_world(mean, {splat.major * pixel, splat.minor * pixel, kFlat},
              {std::cos(splat.angle / 2), 0, 0, std::sin(splat.angle / 2)}, splat.opacity,
              splat.rgb);
}

void HardBuilder::add_world(const glm::dvec3& mean, const glm::dvec3& scale,
                            const glm::dvec4& rotation, double opacity, const glm::dvec3& rgb) {
    GaussianCloud& cloud = scene.cloud;
    cloud.means.push_back(mean);
    cloud.scales.emplace_back(scale);
    cloud.rotations.emplace_back(rotation);
    cloud.opacities.push_back(static_cast<float>(opacity));
    for (int channel = 0; channel < 3; ++channel) {
        cloud.sh.push_back(static_cast<float>((rgb[channel] - 0.5) / kShY0));
    }
    const std::size_t more = 3 * (cloud.sh_coefficients() - 1);
    cloud.sh.insert(cloud.sh.end(), more, 0.0F);
}

void HardBuilder::look(double x, double y, int radius) {
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    PixelBox box;
    box.x0 = std::max(column - radius, 0);
    box.y0 = std::max(row - radius, 0);
    box.x1 = std::min(column + radius, width() - 1);
    box.y1 = std::min(row + radius, height() - 1);
    if (!box.empty()) {
        scene.windows.push_back(box);
    }
}

void repeat_last(GaussianCloud& cloud) {
    const std::size_t values = 3 * cloud.sh_coefficients();
    cloud.means.push_back(cloud.means.back());
    cloud.scales.push_back(cloud.scales.back());
    cloud.rotations.push_back(cloud.rotations.back());
    cloud.opacities.push_back(cloud.opacities.back());
    for (std::size_t i = 0; i < values; ++i) {
        cloud.sh.push_back(cloud.sh[cloud.sh.size() - values]);
    }
}

} // namespace degs
