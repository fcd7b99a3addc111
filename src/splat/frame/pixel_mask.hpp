// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace degs {

/// Bits begin .. end - 1 of a mask of neighbouring pixels; 0 <= begin <= end <= 32.
inline std::uint32_t bits_between(int begin, int end) {
    return static_cast<std::uint32_t>((std::uint64_t{1} << end) - (std::uint64_t{1} << begin));
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
