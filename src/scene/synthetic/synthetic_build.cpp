// SPDX-License-Identifier: Apache-2.0
#include "scene/synthetic/synthetic_build.hpp"

#include <algorithm>
#include <cmath>

#include "scene/cameras/orbit_camera.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

constexpr double kReferenceCount = 100000; ///< sizes in looks are for this many Gaussians
constexpr double kSmallestAxis = 1e-9;     ///< scene units; trained scenes go down to e^-20

} // namespace

SyntheticBuilder::SyntheticBuilder(GaussianCloud& cloud, const SyntheticSpec& spec, int sh_degree)
    : cloud_(cloud), random_(spec.seed),
      size_factor_(std::sqrt(kReferenceCount / static_cast<double>(spec.gaussians))) {
    cloud.sh_degree = sh_degree;
    cloud.means.reserve(spec.gaussians);
    cloud.scales.reserve(spec.gaussians);
    cloud.rotations.reserve(spec.gaussians);
    cloud.opacities.reserve(spec.gaussians);
    cloud.sh.reserve(spec.gaussians * cloud.sh_coefficients() * 3);
}

void SyntheticBuilder::add(const SyntheticLook& look, const glm::dvec3& mean,
                           const glm::dvec3& normal, const glm::dvec3& rgb, double scale) {
    const double largest = look.size.sample(random_) * size_factor_ * scale;
    const double middle = largest / look.elongation.sample(random_);
    const double smallest = std::max(middle / look.flatness.sample(random_), kSmallestAxis);
    const glm::dvec4 rotation = facing(normal);
    const double opacity = look.opacity.sample(random_);
    add_exact(mean, {largest, middle, smallest}, rotation, opacity, rgb, look.view_dependence);
}

void SyntheticBuilder::add_exact(const glm::dvec3& mean, const glm::dvec3& scale,
                                 const glm::dvec4& rotation, double opacity, const glm::dvec3& rgb,
                                 float view_dependence) {
    cloud_.means.push_back(mean);
    cloud_.scales.emplace_back(scale);
    cloud_.rotations.emplace_back(rotation);
    cloud_.opacities.push_back(static_cast<float>(opacity));
    for (int channel = 0; channel < 3; ++channel) {
        cloud_.sh.push_back(static_cast<float>((rgb[channel] - 0.5) / kShY0));
    }
    for (int degree = 1; degree <= cloud_.sh_degree; ++degree, view_dependence /= 2) {
        const int values = 3 * (2 * degree + 1);
        for (int i = 0; i < values; i += 4) {
            const std::array<float, 4> units = random_.signed_units();
            for (int j = 0; j < std::min(4, values - i); ++j) {
                cloud_.sh.push_back(view_dependence * units[j]);
            }
        }
    }
}

glm::dvec4 SyntheticBuilder::facing(const glm::dvec3& normal) {
    const glm::dvec2 turn = random_.on_circle(); // cosine and sine of half an angle
    // The shortest way from z to the normal, times the turn about z.
    glm::dvec4 tilt(1 + normal.z, -normal.y, normal.x, 0);
    if (normal.z < -0.999999) {
        tilt = {0, 1, 0, 0};
    }
    tilt /= std::sqrt(glm::dot(tilt, tilt));
    return {tilt.x * turn.x, tilt.y * turn.x + tilt.z * turn.y, tilt.z * turn.x - tilt.y * turn.y,
            tilt.x * turn.y};
}

std::vector<Camera> synthetic_cameras(const std::array<SyntheticView, 3>& views) {
    struct Format {
        const char* name;
        int width, height; // px
    };
    constexpr std::array<Format, 3> kFormats{
        {{"overview", 640, 480}, {"near", 1280, 720}, {"closeup", 1920, 1080}}};
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < views.size(); ++i) {
        Camera camera = looking_at(views[i].position, views[i].target);
        camera.id = static_cast<int>(i);
        camera.name = kFormats[i].name;
        camera.width = kFormats[i].width;
        camera.height = kFormats[i].height;
        camera.fx = camera.fy = views[i].focal * camera.width;
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

} // namespace degs
