// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace degs {

/// Rows are dealt in turn: unit `a` of `as` owns the rows y = a mod as, unit `b` of `bs` those with
/// y = b mod bs. True if some row belongs to both.
inline bool shares_row(int a, int as, int b, int bs) {
    const int common = std::gcd(as, bs);
    return a % common == b % common;
}

/// Units of the other kind, `bs` in all, that share a row with unit `a` of `as`.
inline std::size_t reachable(int a, int as, int bs) {
    std::size_t count = 0;
    for (int b = 0; b < bs; ++b) {
        count += shares_row(a, as, b, bs) ? 1 : 0;
    }
    return count;
}

/// The port of unit `a` of `as` through which it reaches the unit b of `bs` that owns a row, by row
/// of a tile. Its ports go to the units that share a row with it, in ascending order.
inline std::vector<std::size_t> ports_of_rows(int tile_size, int a, int as, int bs) {
    std::vector<std::size_t> port_of(bs, 0);
    std::size_t port = 0;
    for (int b = 0; b < bs; ++b) {
        if (shares_row(a, as, b, bs)) {
            port_of[b] = port++;
        }
    }
    std::vector<std::size_t> ports(tile_size);
    for (int row = 0; row < tile_size; ++row) {
        ports[row] = port_of[row % bs];
    }
    return ports;
}

} // namespace degs
