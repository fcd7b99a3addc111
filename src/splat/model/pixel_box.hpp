// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace degs {

/// A rectangle of pixels, all ends included; empty if an end lies before its beginning.
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;

    bool empty() const { return x1 < x0 || y1 < y0; }
    int width() const { return std::max(x1 - x0 + 1, 0); }
    int height() const { return std::max(y1 - y0 + 1, 0); }
    bool holds(int x, int y) const { return x0 <= x && x <= x1 && y0 <= y && y <= y1; }
    bool operator==(const PixelBox& other) const {
        return x0 == other.x0 && y0 == other.y0 && x1 == other.x1 && y1 == other.y1;
    }
    bool operator!=(const PixelBox& other) const { return !(*this == other); }
    /// Counts its pixels from (x, y) on.
    PixelBox relative_to(int x, int y) const { return {x0 - x, y0 - y, x1 - x, y1 - y}; }
    /// The part inside `bounds`.
    PixelBox within(const PixelBox& bounds) const {
        return {std::max(x0, bounds.x0), std::max(y0, bounds.y0), std::min(x1, bounds.x1),
                std::min(y1, bounds.y1)};
    }
};

} // namespace degs
