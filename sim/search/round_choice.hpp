// SPDX-License-Identifier: Apache-2.0
// Which designs the next round of a search simulates.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/goals/goals.hpp"
#include "sim/search/forecast.hpp"

namespace degs::sim {

/// A design that could be simulated, and what the simulation would find.
struct Prospect {
    std::size_t variant = 0;
    Expectation expected;
};

/// What is known when a round is chosen.
struct RoundFacts {
    const Aims* aims = nullptr;
    std::vector<std::optional<double>> bounds; ///< of the limits
    std::vector<Columns> front;                ///< what was simulated and is within the limits
    std::vector<Prospect> prospects;
};

/// The variants, at most `count`, that add most hypervolume to the front one after the other, if
/// expectations are wrong by one deviation in their favour (an upper confidence bound, which also
/// goes where little is known); then those that would by two. Without a front expectations are
/// taken as they are, and those that add nothing follow, the ones that miss the limits least first.
/// Empty if nobody is likely to enter the front.
std::vector<std::size_t> choose_round(const RoundFacts& facts, std::size_t count);

} // namespace degs::sim
