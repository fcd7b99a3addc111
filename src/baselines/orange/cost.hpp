// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cost/technology.hpp"

namespace degs::orange {

/// What the blocks of ORANGE take. docs/cost.md argues every value.
struct CostRows {
    cost::UnitRow preprocessing{0, 0.58, 4}, array{4.8, 3.1, 4096}, vector_unit{4.1, 3.0, 2048};
    double sorting_share = 0.02; ///< of preprocessing
    cost::SramRow sram{4.84, 0.15, 1032 * 1024, 8256};
    void describe(cost::RowSection& section);
};

/// What the cores have done, counted by a simulation or expected by an estimate.
struct Work {
    double slots = 0;      ///< of the multipliers
    double formed = 0;     ///< splats with coefficients
    double blended = 0;    ///< splats blended on the tiles
    double keys_moved = 0; ///< by the sorting units
};

} // namespace degs::orange
