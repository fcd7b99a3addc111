// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "splat/model/gaussian.hpp"

namespace degs {

/// x -> linear * x + translation.
struct Affine {
    glm::dmat3 linear{1.0};
    glm::dvec3 translation{0.0};
};

/// Why a linear map cannot move Gaussians: their colours turn with a rotation, and these maps have
/// none.
enum class TransformDefect { None, NonFinite, Singular, Mirrored, Sheared };

/// Columns of `linear` must have finite positive lengths, be orthogonal within 1e-4, and form a
/// right-handed system.
TransformDefect find_transform_defect(const glm::dmat3& linear);

/// The clause that follows "its matrix": "mirrors", "shears", ... Empty for None.
const char* explain(TransformDefect defect);

/// The rotation in a map without defect: its columns at length 1, made orthonormal.
glm::dmat3 rotation_of(const glm::dmat3& linear);

/// Appends `from`, moved by a map without defect, to `to`, whose SH degree is at least that of
/// `from` (missing coefficients are 0). The covariance becomes M Sigma M^T: a uniform scale
/// multiplies the standard deviations; under any other scale they and the rotation follow from the
/// singular values of M R diag(s), to nearly all digits of double however thin the Gaussian is.
/// Coefficients turn with rotation_of(M). What the map leaves alone, e.g. colours if it does not
/// rotate, keeps its bits.
void append_transformed(const GaussianCloud& from, const Affine& map, GaussianCloud& to);

} // namespace degs
