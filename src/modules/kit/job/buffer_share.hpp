// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace degs {

/// A share of a buffer that is split evenly among units.
struct BufferShare {
    double share = 1; ///< of the buffer, above 0
    int units = 1;

    /// Bytes that each unit has of a buffer of `buffer` bytes.
    int bytes_of(int buffer) const { return static_cast<int>(part_of(buffer)); }
    /// Bytes of the smallest buffer of which each unit has at least `bytes`.
    std::int64_t least_buffer(int bytes) const {
        const double wanted = bytes;
        double buffer = std::floor(wanted * units / share) - 1; // the division may round either way
        while (part_of(buffer) < wanted) {
            ++buffer;
        }
        return std::llround(buffer);
    }

private:
    double part_of(double buffer) const { return share * buffer / units; }
};

} // namespace degs
