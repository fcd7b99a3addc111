// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

namespace degs::sim {

/// Nine simulated changes in ten lie within `share` of the time less this, and plus this. Both
/// estimates look at the same tiles, so that most of their errors cancel; measured
/// (docs/analytic.md).
inline double change_half_width(double share) {
    constexpr double kLeast = 0.01, kOfShare = 0.2;
    return kLeast + kOfShare * std::abs(share);
}

/// What a change of a design is worth on a view. Both numbers are estimates of the analytic model,
/// also beside a simulation.
struct WhatIf {
    std::string change; ///< "span.count=16,span.queue=32"
    double cycles_before = 0, cycles_after = 0;
    double share() const { return cycles_after / cycles_before - 1; } ///< below 0: faster
    double half_width() const { return change_half_width(share()); }
};

} // namespace degs::sim
