// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cost/technology.hpp"

namespace degs::gbu {

/// What the blocks of GBU take. docs/cost.md argues every value.
struct CostRows {
    cost::UnitRow preprocessing{0.89, 0.58, 4}, scheduler{0.24, 0.07, 8}, blending{2.88, 0.88, 64};
    double sorting_share = 0.02; ///< of preprocessing
    cost::SramRow sram{0.43, 0.06, 91 * 1024, 2368};
    void describe(cost::RowSection& section);
};

/// What the engines have done, counted by a simulation or expected by an estimate.
struct Work {
    double generating = 0;     ///< cycles in which Row Generation solves rows, of all engines
    double slots = 0;          ///< of Row PEs
    double keys_moved = 0;     ///< by the sorters
    double splats_fetched = 0; ///< records that reach the engines
    double entries_moved = 0;  ///< into the row queues and out of them
    double lookups = 0;        ///< in the reuse caches
};

} // namespace degs::gbu
