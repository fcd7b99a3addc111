// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace degs {

/// A count as a real number.
inline double real_of(std::uint64_t count) {
    return static_cast<double>(count);
}

/// part / whole of two counts, e.g. of hits and accesses; 0 if the whole is 0.
inline double ratio_of(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : real_of(part) / real_of(whole);
}

/// The mean of `count` values from their sum; 0 of no values.
inline double mean_of(double sum, std::uint64_t count) {
    return count == 0 ? 0.0 : sum / real_of(count);
}

/// `count` per `unit` of time or size, e.g. bytes per second; 0 if the unit is 0.
inline double rate_of(std::uint64_t count, double unit) {
    return unit == 0 ? 0.0 : real_of(count) / unit;
}

} // namespace degs
