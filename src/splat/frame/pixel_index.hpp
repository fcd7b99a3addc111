// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace degs {

/// Rows or columns of pixels, `first` to `last`, both included; empty if `last` < `first`.
struct PixelRange {
    int first = 0, last = -1;

    bool empty() const { return last < first; }
    int size() const { return empty() ? 0 : last - first + 1; }
    bool holds(int pixel) const { return first <= pixel && pixel <= last; }
    /// The part inside `bounds`.
    PixelRange within(const PixelRange& bounds) const {
        return {std::max(first, bounds.first), std::min(last, bounds.last)};
    }
    /// The smallest range that holds both.
    PixelRange joined(const PixelRange& other) const {
        return empty() ? other
               : other.empty()
                   ? *this
                   : PixelRange{std::min(first, other.first), std::max(last, other.last)};
    }
    /// With `pixels` more at either end.
    PixelRange widened(int pixels) const { return {first - pixels, last + pixels}; }
    /// Counted from `origin`.
    PixelRange relative_to(int origin) const { return {first - origin, last - origin}; }
};

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
