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

} // namespace degs::gcc
