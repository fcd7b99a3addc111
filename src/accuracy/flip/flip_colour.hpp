// SPDX-License-Identifier: Apache-2.0
// Colour spaces of FLIP. Internal to flip_difference.
#pragma once

#include <glm/glm.hpp>

namespace degs {

/// sRGB, limited to 0 .. 1, to linear light.
glm::dvec3 linear_of_srgb(const glm::dvec3& srgb);
/// Linear light to YCxCz, a linear relative of CIELAB, and back; white is that of sRGB.
glm::dvec3 ycxcz_of_linear(const glm::dvec3& rgb);
glm::dvec3 linear_of_ycxcz(const glm::dvec3& ycxcz);
/// Linear light to CIELAB with the Hunt effect: chroma grows with lightness.
glm::dvec3 hunt_lab_of_linear(const glm::dvec3& rgb);

/// |dL| + distance of (a, b).
double hyab_distance(const glm::dvec3& lab, const glm::dvec3& other);

} // namespace degs
