// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cost/technology.hpp"

namespace degs::gcc {

/// What the blocks of GCC take. docs/cost.md argues every value.
struct CostRows {
    cost::UnitRow preprocessing{0.72, 0.30, 12}, blending{0.96, 0.44, 64};
    cost::SramRow sram{1.01, 0.05, 190 * 1024, 2112};
    void describe(cost::RowSection& section);
};

/// What the stages have done, counted by a simulation or expected by an estimate.
struct Work {
    double means = 0;           ///< that Stage I has read
    double entries = 0;         ///< of groups, taken by Stage II
    double shapes = 0;          ///< Gaussians projected
    double coloured = 0;        ///< Gaussians with a colour
    double records_fetched = 0; ///< by an array alone, in place of the stages before it
    double slots = 0;           ///< of the windows
};

} // namespace degs::gcc
