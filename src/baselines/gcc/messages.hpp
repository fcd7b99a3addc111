// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/kit/job/messages.hpp"

namespace degs::gcc {

/// A block of a view whose pixels have all ended, window array -> Stage III.
struct BlockEnded {
    TileNumber view = 0;
    std::int16_t row = 0, column = 0; ///< in blocks, inside the view
};

} // namespace degs::gcc
