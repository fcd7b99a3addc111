// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "degs/error.hpp"

namespace degs {

/// The largest power of two up to `most` >= 1.
inline int power_of_two_below(int most) {
    int power = 1;
    while (power <= most / 2) {
        power *= 2;
    }
    return power;
}

/// floor(sqrt(square)) of a number >= 0.
inline int whole_root(int square) {
    int root = static_cast<int>(std::sqrt(double(square)));
    root -= root * root > square ? 1 : 0;
    return root;
}

/// Side of a tile that grows with the square root of the PEs from 32 px at 64 PEs (paper, Table
/// II), rounded down to a power of two.
inline int family_tile(int pes) {
    constexpr int kSquareOfRatio = 16; // (32 px)^2 / 64 PEs
    return power_of_two_below(whole_root(kSquareOfRatio * pes));
}

/// What is `at_64` with 64 PEs and follows their number.
inline int per_pe(int at_64, int pes) {
    constexpr int kPaperPes = 64;
    return static_cast<int>(std::int64_t{at_64} * pes / kPaperPes);
}

/// Throws InputError unless `possible(pes)`. The sentence has `rule` ("must be a square") and the
/// nearest number of PEs below and above, up to `most`, for which it holds.
template <class Possible>
void require_family_size(const std::string& family, int pes, int most, const std::string& rule,
                         const Possible& possible) {
    if (pes >= 1 && pes <= most && possible(pes)) {
        return;
    }
    int below = std::min(pes - 1, most);
    while (below >= 1 && !possible(below)) {
        --below;
    }
    int above = std::max(pes + 1, 1);
    while (above <= most && !possible(above)) {
        ++above;
    }
    std::string nearest = below >= 1 ? std::to_string(below) : "";
    if (above <= most) {
        nearest += (nearest.empty() ? "" : " or ") + std::to_string(above);
    }
    throw InputError("--pes " + std::to_string(pes) + ": the number of PEs of " + family + " " +
                     rule + "; the nearest that will do is " + nearest + ".");
}

} // namespace degs
