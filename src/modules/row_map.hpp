// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numeric>

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

} // namespace degs
