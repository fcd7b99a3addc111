// SPDX-License-Identifier: Apache-2.0
#include "scene/dynamic/spacetime.hpp"

#include <algorithm>
#include <cmath>

namespace degs {
namespace {

constexpr double kY0 = 0.28209479177387814; // spherical harmonic of degree 0

bool all_finite(const SpacetimeGaussian& g) {
    const double sum =
        g.mean.x + g.mean.y + g.mean.z + g.centre + g.log_duration + g.opacity +
        glm::dot(glm::dvec3(g.motion[0] + g.motion[1] + g.motion[2]), glm::dvec3(1)) +
        glm::dot(glm::dvec3(g.rgb + g.log_scale), glm::dvec3(1)) +
        glm::dot(glm::dvec4(g.rotation), glm::dvec4(1)) +
        glm::dot(glm::dvec4(g.omega), glm::dvec4(1));
    return std::isfinite(sum) && std::isfinite(std::exp(static_cast<double>(g.log_scale.x))) &&
           std::isfinite(std::exp(g.log_scale.y)) && std::isfinite(std::exp(g.log_scale.z));
}

} // namespace

GaussianCloud at_time(const SpacetimeCloud& scene, double t) {
    GaussianCloud cloud;
    cloud.means.reserve(scene.size());
    cloud.scales.reserve(scene.size());
    cloud.rotations.reserve(scene.size());
    cloud.opacities.reserve(scene.size());
    cloud.sh.reserve(scene.size() * 3);
    for (const SpacetimeGaussian& g : scene) {
        const double d = t - g.centre;
        const glm::dvec3 moved = glm::dvec3(g.mean) + d * glm::dvec3(g.motion[0]) +
                                 d * d * glm::dvec3(g.motion[1]) +
                                 d * d * d * glm::dvec3(g.motion[2]);
        cloud.means.push_back(moved);
        cloud.scales.emplace_back(glm::exp(glm::dvec3(g.log_scale)));
        const glm::dvec4 turned = glm::dvec4(g.rotation) + d * glm::dvec4(g.omega);
        const double length = glm::length(turned);
        cloud.rotations.emplace_back(length > 0 ? turned / length : glm::dvec4(1, 0, 0, 0));
        const double age = d / std::exp(static_cast<double>(g.log_duration));
        const double opacity = 1 / (1 + std::exp(-static_cast<double>(g.opacity)));
        cloud.opacities.push_back(static_cast<float>(opacity * std::exp(-age * age)));
        for (int channel = 0; channel < 3; ++channel) {
            cloud.sh.push_back(static_cast<float>((g.rgb[channel] - 0.5) / kY0));
        }
    }
    return cloud;
}

std::uint64_t sanitize(SpacetimeCloud& scene) {
    const std::size_t before = scene.size();
    scene.erase(std::remove_if(scene.begin(), scene.end(),
                               [](const SpacetimeGaussian& g) { return !all_finite(g); }),
                scene.end());
    return before - scene.size();
}

} // namespace degs
