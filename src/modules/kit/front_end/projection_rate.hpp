// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// How fast a unit projects Gaussians, whatever stands around it.
struct ProjectionRate {
    int cycles_per_gaussian = 1; ///< initiation interval, of the linear projection
    int unscented_passes = 4;    ///< of a Gaussian, by the ratio of operations
    void describe(ConfigVisitor& visitor);
    /// Cycles that a unit takes to project a Gaussian.
    int project_cycles(ProjectionRule rule) const {
        return cycles_per_gaussian * (rule == ProjectionRule::Unscented ? unscented_passes : 1);
    }
};

} // namespace degs
