// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/random/dice.hpp"
#include "tests/random/key_list.hpp"

namespace degs::trials {

/// A value that the key's range allows, as text: near an end of the range, anywhere in it, or near
/// what it is.
std::string draw_value(Dice& dice, const Key& key);

/// A key of the list. Every section has the weight of a single key beside it, so that large
/// sections do not crowd out the others.
const Key& draw_key(Dice& dice, const std::vector<Key>& keys);

} // namespace degs::trials
