// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs::sim {

/// What a change of a design is worth on a view. Both numbers are estimates of the analytic model,
/// also beside a simulation.
struct WhatIf {
    std::string change; ///< "span.count=16,span.queue=32"
    double cycles_before = 0, cycles_after = 0;
    double share() const { return cycles_after / cycles_before - 1; } ///< below 0: faster
};

} // namespace degs::sim
