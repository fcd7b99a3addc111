// SPDX-License-Identifier: Apache-2.0
#include "sim/search/rank_correlation.hpp"

#include <cmath>
#include <cstddef>

namespace degs::sim {
namespace {

/// Ranks from 1; equal values share the mean of theirs.
std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<double> ranks(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::size_t less = 0;
        std::size_t equal = 0;
        for (const double other : values) {
            less += other < values[i] ? 1 : 0;
            equal += other == values[i] ? 1 : 0;
        }
        ranks[i] = static_cast<double>(less) + (static_cast<double>(equal) + 1) / 2;
    }
    return ranks;
}

} // namespace

std::optional<double> rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    constexpr std::size_t kFewest = 3;
    if (a.size() < kFewest) {
        return {};
    }
    const std::vector<double> first = ranks_of(a);
    const std::vector<double> second = ranks_of(b);
    const double mean = (static_cast<double>(a.size()) + 1) / 2;
    double covariance = 0;
    double spread_a = 0;
    double spread_b = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        covariance += (first[i] - mean) * (second[i] - mean);
        spread_a += (first[i] - mean) * (first[i] - mean);
        spread_b += (second[i] - mean) * (second[i] - mean);
    }
    if (spread_a == 0 || spread_b == 0) {
        return {};
    }
    return covariance / std::sqrt(spread_a * spread_b);
}

} // namespace degs::sim
