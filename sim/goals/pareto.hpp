// SPDX-License-Identifier: Apache-2.0
// Fronts of designs in any number of goals.
#pragma once

#include <cstddef>
#include <vector>

namespace degs::sim {

/// As many numbers for each design. The functions below take them as costs, which shall be small.
using Goals = std::vector<double>;

/// The positions of all: the front, the front of the rest, and so on, each in the order of the
/// first goal. Of equal ones the first counts.
std::vector<std::vector<std::size_t>> fronts_of(const std::vector<Goals>& goals);

/// Positions of those that no other beats: none is at least as good in all goals and better in
/// one. In the order of the first goal. Of equal ones the first counts.
std::vector<std::size_t> pareto_front(const std::vector<Goals>& goals);

} // namespace degs::sim
