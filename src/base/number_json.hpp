// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <nlohmann/json.hpp>

namespace degs {

/// JSON has no infinity: it is the string "inf" or "-inf". What is not a number is null.
nlohmann::ordered_json number_json(double value);

/// What does not exist is null.
nlohmann::ordered_json value_or_null(const std::optional<double>& number);
template <class Value>
nlohmann::ordered_json value_or_null(const std::optional<Value>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

} // namespace degs
