// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/random/trial.hpp"

namespace degs::trials {

/// What it took to draw designs that can be built.
struct DrawCounts {
    std::uint64_t drawn = 0;   ///< designs
    std::uint64_t refused = 0; ///< of them, refused by the configuration as they were first drawn
    std::uint64_t dropped = 0; ///< changes taken back to repair them
    std::uint64_t changes = 0; ///< that stayed
};

/// The design number `index` of a seed, and a scene for it. The same arguments give the same design
/// as long as the accelerators have the same keys.
Trial draw_trial(const std::string& configs, std::uint64_t seed, std::uint64_t index,
                 DrawCounts& counts);

/// The sentence with which the configuration refuses the design; empty if it can be built.
std::string refusal(const std::string& configs, const Trial& trial);

} // namespace degs::trials
