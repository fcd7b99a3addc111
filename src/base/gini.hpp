// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace degs {

/// The Gini coefficient of values that are not negative: 0 if all are the same, near 1 if a few
/// have nearly all. 0 for an empty list and for zeros alone.
inline double gini(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    double total = 0;
    double ranked = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        total += values[i];
        ranked += static_cast<double>(i + 1) * values[i];
    }
    const auto n = static_cast<double>(values.size());
    return total > 0 ? 2 * ranked / (n * total) - (n + 1) / n : 0;
}

} // namespace degs
