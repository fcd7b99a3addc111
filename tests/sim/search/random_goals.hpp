// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "sim/goals/pareto.hpp"

namespace degs::sim_test {

inline std::vector<sim::Goals> random_goals(std::mt19937& random, std::size_t designs,
                                            std::size_t count) {
    std::uniform_int_distribution<int> number(1, 9); // so that many are equal
    std::vector<sim::Goals> goals(designs, sim::Goals(count));
    for (sim::Goals& each : goals) {
        for (double& goal : each) {
            goal = number(random);
        }
    }
    return goals;
}

} // namespace degs::sim_test
