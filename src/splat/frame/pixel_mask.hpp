// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "splat/frame/pixel_index.hpp"

namespace degs {

/// Bits begin .. end - 1 of a mask of neighbouring pixels; 0 <= begin <= end <= 32.
inline std::uint32_t bits_between(int begin, int end) {
    return static_cast<std::uint32_t>((std::uint64_t{1} << end) - (std::uint64_t{1} << begin));
}

/// The bits of `pixels` in a mask of `count` neighbouring pixels, at most 32.
inline std::uint32_t bits_of(const PixelRange& pixels, int count) {
    const PixelRange inside = pixels.within({0, count - 1});
    return inside.empty() ? 0U : bits_between(inside.first, inside.last + 1);
}

/// A bit for each of up to 128 neighbouring pixels.
struct RowMask {
    static constexpr int kHalf = 64;
    static constexpr int kBits = 32; // that from() returns
    std::uint64_t low = 0, high = 0;

    /// Sets bit `column` if bit 0 of `bits` is set, and so on.
    void put(std::uint64_t bits, int column) {
        if (column < kHalf) {
            low |= bits << column;
            high |= bits >> 1 >> (kHalf - 1 - column);
        } else {
            high |= bits << (column - kHalf);
        }
    }
    /// Bits column .. column + 31; those beyond the last one are 0.
    std::uint32_t from(int column) const {
        const int within = column % kHalf;
        const std::uint64_t bits = (column < kHalf ? low : high) >> within;
        return static_cast<std::uint32_t>(column < kHalf && within > kHalf - kBits
                                              ? bits | high << 1 << (kHalf - 1 - within)
                                              : bits);
    }
    int count() const { return __builtin_popcountll(low) + __builtin_popcountll(high); }
};
inline bool operator==(const RowMask& a, const RowMask& b) {
    return a.low == b.low && a.high == b.high;
}

/// The lowest `count` set bits of `mask`, which has more than that; 0 < count < 32.
inline std::uint32_t lowest_bits(std::uint32_t mask, int count) {
    const std::uint32_t lowest = mask & (0U - mask);
    const std::uint32_t first = (lowest << count) - lowest;
    if ((mask & first) == first) { // neighbours, as nearly always
        return first;
    }
    std::uint32_t picked = 0;
    for (; count > 0; --count) {
        picked |= mask & (0U - mask);
        mask &= mask - 1;
    }
    return picked;
}

} // namespace degs
