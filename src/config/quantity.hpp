// SPDX-License-Identifier: Apache-2.0
// Numbers with units as configurations and studies write them: 16KB, 51.2GB/s, 25%; studies also
// x1/4.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/config_tree.hpp"

namespace degs {

struct Quantity {
    double number = 0;
    std::string unit;    ///< as written; empty: that of the key
    bool factor = false; ///< times the value that the design has
};

/// Reads a whole text: a decimal number with an optional unit, or 'x' and a number or a fraction
/// ("x0.25", "x1/4"). Empty if the text is neither. Whether a unit exists is not looked at.
std::optional<Quantity> parse_quantity(const std::string& text);

/// A number as text, without what arithmetic on decimals adds: fifteen significant digits at most,
/// without trailing zeros (76.8 for 76.80000000000001).
std::string decimal_text(double value);

/// What a number with a unit is a value of.
struct QuantityKey {
    std::string path;
    std::string doc; ///< the sentence of the key, which begins with its unit
};

/// The units that fit the key; none if it has no dimension.
std::vector<std::string> units_of(const QuantityKey& key);

/// The number, which is no factor, in the unit of the key. Throws InputError, which begins with
/// `place` and lists the units of the key, for one that does not fit what the key means.
double in_unit_of(const QuantityKey& key, const Quantity& quantity, const std::string& place);

/// `node`, or if it is a plain number with a unit (8KB), the same node with the number in the unit
/// of the key (8192). Throws InputError as in_unit_of().
ConfigNode in_unit_of(const QuantityKey& key, const ConfigNode& node);

} // namespace degs
