// SPDX-License-Identifier: Apache-2.0
// The hypervolume of a front: how much of the space it beats.
#pragma once

#include <vector>

#include "sim/goals/pareto.hpp"

namespace degs::sim {

/// The volume of what at least one of the points beats and what beats `worst`; the points are
/// costs, and the larger the volume, the better they are. Points that are not better than `worst`
/// everywhere count nothing. (L. While et al., A Fast Way of Calculating Exact Hypervolumes, IEEE
/// Trans. Evol. Comput. 2012.)
double hypervolume(const std::vector<Goals>& points, const Goals& worst);

/// By how much the volume grows with another point.
double hypervolume_gain(const std::vector<Goals>& points, const Goals& another, const Goals& worst);

} // namespace degs::sim
