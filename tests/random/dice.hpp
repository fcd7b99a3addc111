// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "scene/synthetic/synthetic_random.hpp"

namespace degs::trials {

/// Random choices that are the same everywhere.
class Dice {
public:
    Dice(std::uint64_t seed, std::uint64_t index) : random_(mixed(mixed(seed) + index)) {}

    bool chance(double probability) { return random_.uniform() < probability; }
    double uniform(double low, double high) { return random_.uniform(low, high); }
    /// 0 .. count - 1
    int below(int count) { return static_cast<int>(random_.uniform() * count); }
    /// low .. high, both positive; every power of two is as likely as any other.
    double log_uniform(double low, double high) {
        return low * portable_exp(random_.uniform() * portable_log(high / low));
    }
    /// Whole numbers low .. high, the same way; low may be 0.
    std::int64_t log_integer(std::int64_t low, std::int64_t high) {
        const auto span = static_cast<double>(high - low + 2);
        const auto drawn = low - 1 + static_cast<std::int64_t>(log_uniform(1, span));
        return drawn < low ? low : drawn > high ? high : drawn;
    }
    template <class T>
    const T& one_of(const std::vector<T>& list) {
        return list[below(static_cast<int>(list.size()))];
    }

private:
    /// SplitMix64's output function: neighbouring seeds give unrelated sequences.
    static std::uint64_t mixed(std::uint64_t x) {
        x += 0x9e3779b97f4a7c15U;
        x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
        x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
        return x ^ (x >> 31U);
    }

    SyntheticRandom random_;
};

} // namespace degs::trials
