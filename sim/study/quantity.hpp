// SPDX-License-Identifier: Apache-2.0
// Numbers with units as a study writes them: 16KB, 51.2GB/s, 25%, x1/4.
#pragma once

#include <optional>
#include <string>

#include "config/config_document.hpp"

namespace degs::sim {

struct Quantity {
    double number = 0;
    std::string unit;    ///< as written; empty: that of the key
    bool factor = false; ///< times the value that the design has
};

/// Reads a whole text: a decimal number with an optional unit, or 'x' and a number or a fraction
/// ("x0.25", "x1/4"). Empty if the text is neither. Whether a unit exists is not looked at.
std::optional<Quantity> parse_quantity(const std::string& text);

/// The number in the unit of `key`, which is a real or an integer with the design's own value.
/// Throws InputError, which begins with `place`, for a unit that does not fit what the key means.
double in_unit_of(const KeyDoc& key, const Quantity& quantity, const std::string& place);

} // namespace degs::sim
