// SPDX-License-Identifier: Apache-2.0
// Axis conventions of scene files, and the mirrorings between them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// Where +X, +Y and +Z of a world point: right or left, down or up, forward or back. The default is
/// that of the original 3DGS code and of its PLY files: RDF.
struct Axes {
    glm::dvec3 signs{
        1.0}; ///< each +1 or -1: how many right, down, forward a step along +X, +Y, +Z goes

    /// Three letters, e.g. "RDF".
    std::string name() const;
    bool operator==(const Axes& other) const { return signs == other.signs; }
    bool operator!=(const Axes& other) const { return signs != other.signs; }
};

/// One of R L, one of D U, one of F B, in this order and either case; nothing for other texts.
std::optional<Axes> parse_axes(std::string_view letters);

/// +1 or -1 for each spherical harmonic Y_k, k < 16: what becomes of its coefficient.
std::array<float, 16> sh_signs(const Axes& from, const Axes& to);

/// Rewrites a cloud of world `from` for world `to`. Exact: only signs change. An odd number of
/// opposite axes gives the mirror image in coordinates, which is the same scene in the world.
void convert_axes(GaussianCloud& cloud, const Axes& from, const Axes& to);
/// Rewrites cameras of world `from` for world `to`; with an odd number of opposite axes their bases
/// become left-handed.
void convert_axes(std::vector<Camera>& cameras, const Axes& from, const Axes& to);

} // namespace degs
