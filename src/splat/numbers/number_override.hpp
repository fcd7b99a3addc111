// SPDX-License-Identifier: Apache-2.0
// Parts of a number set by name, for configurations and command lines.
#pragma once

#include <string>
#include <vector>

#include "splat/numbers/number_set.hpp"

namespace degs {

/// "alpha", "exp.entries": a stage's format, a size of a table, or an order of operations.
struct NumberKey {
    std::string name;
    std::string meaning;
};
const std::vector<NumberKey>& number_keys();

/// Gives a part another value and adds it to the set's name. Returns what the value must be
/// instead, "must be ..., not 'q99'", or nothing; an unknown name, too.
std::string override_number(NumberSet& set, const std::string& name, const std::string& value);

/// What a set needs beyond valid parts: a sign where values have one, range where it decides,
/// tables with entries. InputError names the part.
void check_numbers(const NumberSet& set);

/// A set by its name and "part=value" assignments, checked. InputError names what is wrong.
NumberSet number_set(const std::string& name, const std::vector<std::string>& assignments);

} // namespace degs
