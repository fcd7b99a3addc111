// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace degs {

/// For each point the mean of the squared distances to its three nearest other points, as the
/// original 3DGS code starts its scales; with fewer than three others, of those there are (0 if
/// none). Coordinates are finite. O(n log n), on all processors.
std::vector<double> mean_squared_distances(const std::vector<glm::dvec3>& points);

} // namespace degs
