// SPDX-License-Identifier: Apache-2.0
// Which of several designs are kept and bred from.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/goals/pareto.hpp"

namespace degs::sim {

/// Positions of the best `count`, at most all: the front, then the front of the rest, and so on.
/// From the last front that does not fit, those drop out one by one whose neighbours in every goal
/// are closest, in ratios; the best in a goal stay longest. In ascending order. (The crowding
/// distance of K. Deb et al., A fast and elitist multiobjective genetic algorithm: NSGA-II, IEEE
/// Trans. Evol. Comput. 2002, in logarithms, renewed after each loss.)
std::vector<std::size_t> best_of(const std::vector<Goals>& goals, std::size_t count);

/// As best_of(), of those whose `excess` over limits is 0; where they are too few, of the others,
/// those that exceed least. The former come first.
std::vector<std::size_t> best_within(const std::vector<Goals>& goals,
                                     const std::vector<double>& excess, std::size_t count);

/// How good one of several designs is.
struct Standing {
    std::size_t front = 0; ///< 0: nobody beats it; 1: only those of front 0 do; and so on
    double room = 0; ///< the distances that decide in best_of(); infinite for the best in a goal
};
std::vector<Standing> standings_of(const std::vector<Goals>& goals);

} // namespace degs::sim
