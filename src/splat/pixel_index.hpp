// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace degs {

/// A coordinate as an index within low .. high: towards zero, after it has been limited.
inline int index_within(double coordinate, double low, double high) {
    return static_cast<int>(std::clamp(coordinate, low, high));
}

/// A row, column or length inside a tile, as the messages between the stages hold it: no side of a
/// tile exceeds 16 bits.
inline std::int16_t inside_tile(int pixels) {
    return static_cast<std::int16_t>(pixels);
}

} // namespace degs
