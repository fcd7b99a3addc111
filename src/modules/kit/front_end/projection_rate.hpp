// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "config/config.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// How fast a unit projects Gaussians, whatever stands around it.
struct ProjectionRate {
    int cycles_per_gaussian = 1;        ///< initiation interval, of the linear projection
    int unscented_passes = 4;           ///< of a Gaussian, by the ratio of operations
    double unscented_operations = 3.99; ///< of a Gaussian, relative to the linear projection
    void describe(ConfigVisitor& visitor);
    /// Cycles that a unit takes to project a Gaussian.
    int project_cycles(ProjectionRule rule) const {
        return cycles_per_gaussian * (rule == ProjectionRule::Unscented ? unscented_passes : 1);
    }
    /// Arithmetic units that it has, relative to a unit of the linear projection: those operations
    /// that its passes do not have time for are done beside each other.
    double arithmetic(ProjectionRule rule) const {
        return rule == ProjectionRule::Unscented
                   ? std::max(1.0, unscented_operations / unscented_passes)
                   : 1;
    }
};

} // namespace degs
