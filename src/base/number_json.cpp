// SPDX-License-Identifier: Apache-2.0
#include "base/number_json.hpp"

#include <cmath>

namespace degs {

nlohmann::ordered_json number_json(double value) {
    if (std::isinf(value)) {
        return value > 0 ? "inf" : "-inf";
    }
    return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

nlohmann::ordered_json value_or_null(const std::optional<double>& number) {
    return number ? number_json(*number) : nlohmann::ordered_json();
}

} // namespace degs
