// SPDX-License-Identifier: Apache-2.0
// Where the PE-cycles of a run went that blended nothing, and the keys that move them.
#pragma once

#include <string>
#include <vector>

#include "sim/simulation/run_result.hpp"

namespace degs::sim {

struct Loss {
    std::string reason;
    double share = 0;           ///< of PEs x cycles of the run
    std::vector<LossStep> keys; ///< only those that can move it in this design
};

/// All of them, the largest first; with `useful / (PEs x cycles)` they add up to 1. Empty without
/// any cycles.
std::vector<Loss> losses_of(const RunResult& result);
/// The three largest.
std::vector<Loss> largest_losses(const RunResult& result);
/// The changes that they name, each once.
std::vector<std::string> named_changes(const RunResult& result);
/// The change that gains most among those that a loss names; null if none was estimated.
const WhatIf* best_gain(const Loss& loss, const RunResult& result);
/// The three largest as one line.
std::string losses_line(const RunResult& result);

} // namespace degs::sim
