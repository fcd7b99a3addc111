// SPDX-License-Identifier: Apache-2.0
// Gaussians that move, turn and fade over time.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "splat/model/gaussian.hpp"

namespace degs {

/// A Gaussian of the lite model of SpacetimeGaussians (Li et al., CVPR 2024), with the values of
/// its PLY file. With d = t - centre:
///   mean(t)     = mean + d motion[0] + d^2 motion[1] + d^3 motion[2]
///   rotation(t) = normalised rotation + d omega
///   opacity(t)  = sigmoid(opacity) exp(-(d / exp(log_duration))^2)
struct SpacetimeGaussian {
    glm::vec3 mean{0.0F};      ///< scene units, at t = centre
    float centre = 0;          ///< in time, 1 is the length of the scene
    float log_duration = 0;    ///< ln of the time after which opacity has fallen to 1/e
    glm::vec3 motion[3]{};     ///< scene units per time, time^2 and time^3
    glm::vec3 rgb{0.0F};       ///< colour from all sides, 0..1
    float opacity = 0;         ///< logit
    glm::vec3 log_scale{0.0F}; ///< ln of the standard deviations in scene units, constant
    glm::vec4 rotation{0.0F};  ///< quaternion w x y z, not normalised
    glm::vec4 omega{0.0F};     ///< change of `rotation` per time
};

using SpacetimeCloud = std::vector<SpacetimeGaussian>;

/// The Gaussians at time `t` (0..1), SH degree 0, in the order of the scene, none left out: those
/// that have not appeared yet or are gone have an opacity near 0. The original draws colours
/// without the lower bound of 0 that colours from spherical harmonics have here.
GaussianCloud at_time(const SpacetimeCloud& scene, double t);

/// Removes Gaussians that hold NaN or infinity, or cannot be drawn at any time; returns how many.
std::uint64_t sanitize(SpacetimeCloud& scene);

} // namespace degs
