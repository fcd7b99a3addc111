// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace degs {

/// Bits begin .. end - 1 of a mask of neighbouring pixels; 0 <= begin <= end <= 32.
inline std::uint32_t bits_between(int begin, int end) {
    return static_cast<std::uint32_t>((std::uint64_t{1} << end) - (std::uint64_t{1} << begin));
}

} // namespace degs
