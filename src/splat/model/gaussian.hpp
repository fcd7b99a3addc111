// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace degs {

/// A set of 3D Gaussians in world space, structure of arrays, all arrays of one length.
/// World axes are those of the file; nothing is flipped.
struct GaussianCloud {
    int sh_degree = 0;                ///< 0..3
    std::vector<glm::dvec3> means;    ///< scene units; double, so that large world offsets survive
    std::vector<glm::vec3> scales;    ///< standard deviations, linear, scene units, >= 0
    std::vector<glm::vec4> rotations; ///< unit quaternions as .x = w, .y = x, .z = y, .w = z
    std::vector<float> opacities;     ///< linear, 0..1
    std::vector<float> sh;            ///< raw coefficients, [gaussian][coefficient][channel r g b]

    std::size_t size() const { return means.size(); }
    bool empty() const { return means.empty(); }
    /// Coefficients per channel: (degree + 1)^2.
    int sh_coefficients() const { return (sh_degree + 1) * (sh_degree + 1); }
    const float* sh_of(std::size_t gaussian) const {
        return sh.data() + gaussian * sh_coefficients() * 3;
    }
};

/// How many Gaussians `sanitize` removed, by reason.
struct SanitizeReport {
    std::uint64_t non_finite = 0;    ///< NaN or infinity in any attribute
    std::uint64_t zero_rotation = 0; ///< quaternion of length zero (a truncated export)
    std::uint64_t bad_scale = 0;     ///< negative scale
    std::uint64_t bad_opacity = 0;   ///< opacity outside 0..1
    std::uint64_t total() const { return non_finite + zero_rotation + bad_scale + bad_opacity; }
    /// One sentence: how many were dropped, and why.
    std::string explain() const;
};

/// Removes Gaussians that no renderer can draw and normalises the other quaternions (in double).
/// Order is kept, because equal depths are blended in index order.
SanitizeReport sanitize(GaussianCloud& cloud);

} // namespace degs
