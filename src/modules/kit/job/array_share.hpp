// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace degs {

/// What one of several like arrays works on, and where its pixels are.
struct ArrayShare {
    std::size_t inputs = 1; ///< rings of splats, one per sorter
    int contexts = 1;       ///< an array's n-th tile lives in context first_context + n modulo this
    int first_context = 0;  ///< in the data path
    /// True if tiles are granted: they come one by one, ascending, on one ring, until kNoTile.
    /// False if all tiles of the job come.
    bool granted = false;
};

} // namespace degs
