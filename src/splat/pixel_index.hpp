// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace degs {

/// A coordinate as an index within low .. high: towards zero, after it has been limited.
inline int index_within(double coordinate, double low, double high) {
    return static_cast<int>(std::clamp(coordinate, low, high));
}

} // namespace degs
