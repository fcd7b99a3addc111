// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cost/technology.hpp"

namespace degs::gscore {

/// What the blocks of GSCore take. docs/cost.md argues every value.
struct CostRows {
    cost::UnitRow preprocessing{0.89, 0.58, 4}, blending{1.81, 0.25, 64};
    double sorting_share = 0.02; ///< of preprocessing
    cost::SramRow sram{1.25, 0.04, 272 * 1024, 2240};
    void describe(cost::RowSection& section);
};

} // namespace degs::gscore
