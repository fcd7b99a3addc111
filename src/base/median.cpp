// SPDX-License-Identifier: Apache-2.0
#include "base/median.hpp"

#include <algorithm>

namespace degs {

std::optional<double> median_of(std::vector<double> values) {
    if (values.empty()) {
        return {};
    }
    std::sort(values.begin(), values.end());
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

} // namespace degs
