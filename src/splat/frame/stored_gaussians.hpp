// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "splat/model/gaussian.hpp"
#include "splat/numbers/projection_numbers.hpp"

namespace degs {

/// The Gaussians of a scene as a memory holds them: every value rounded once to its format, so that
/// what is computed with is what is read.
///
/// Means are rounded relative to an origin. On each axis it is that of the scene, unless 98 % of
/// the coordinates lie on one side of it; then it is their median (of 4096 of them). A scene in map
/// coordinates of 10^6 m would have no digits left otherwise. Scales and coefficients beyond their
/// format saturate, a mean does not: it is infinite, and the Gaussian degenerate.
class StoredGaussians {
public:
    /// Coefficients of degree 3, three channels each.
    using Sh = std::array<float, 48>;

    /// The cloud outlives these.
    StoredGaussians(const GaussianCloud& cloud, const ProjectionNumbers& numbers);

    glm::dvec3 mean(std::size_t index) const {
        return rounds_means_ ? rounded_mean(index) : cloud_.means[index];
    }
    /// The mean as the scene has it.
    const glm::dvec3& given_mean(std::size_t index) const { return cloud_.means[index]; }
    glm::dvec3 scale(std::size_t index) const {
        const glm::dvec3 given(cloud_.scales[index]);
        return as_they_are_
                   ? given
                   : glm::min(glm::dvec3(scale_(given.x), scale_(given.y), scale_(given.z)),
                              most_scale_);
    }
    /// A quaternion in slot order w, x, y, z; rounding leaves its length at about 1.
    glm::dvec4 rotation(std::size_t index) const {
        const glm::dvec4 given(cloud_.rotations[index]);
        return as_they_are_ ? given
                            : glm::dvec4(rotation_(given.x), rotation_(given.y), rotation_(given.z),
                                         rotation_(given.w));
    }
    double opacity(std::size_t index) const {
        const double given = cloud_.opacities[index];
        return as_they_are_ ? given : opacity_(given);
    }
    /// The 3 (degree + 1)^2 coefficients, rounded into `room`, or where the cloud has them if
    /// nothing is to be rounded.
    const float* sh(std::size_t index, Sh& room) const;
    int sh_degree() const { return cloud_.sh_degree; }

private:
    glm::dvec3 rounded_mean(std::size_t index) const;

    const GaussianCloud& cloud_;
    bool as_they_are_, rounds_means_, rounds_sh_;
    Rounder mean_, scale_, rotation_, opacity_, sh_dc_, sh_rest_;
    double most_scale_, most_sh_dc_, most_sh_rest_;
    glm::dvec3 origin_{0.0};
};

} // namespace degs
