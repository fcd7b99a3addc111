// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace degs {

/// A smooth function of the place with values in [0, 1): random numbers at whole coordinates,
/// joined smoothly. It is the same on every platform, because it takes only sums and products.
/// Coordinates within +-10^6.
double lattice_noise(const glm::dvec3& at);

} // namespace degs
