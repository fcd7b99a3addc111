// SPDX-License-Identifier: Apache-2.0
// The keys of a configuration as values may be drawn for them.
#pragma once

#include <string>
#include <vector>

#include "sim/design/run_config.hpp"
#include "splat/numbers/number_set.hpp"

namespace degs::trials {

struct Key {
    enum class Kind { Integer, Real, Word, Text };
    std::string path;
    Kind kind = Kind::Integer;
    double low = 0, high = 0;       ///< of Integer and Real, inclusive
    double value = 0;               ///< of Integer and Real, as it stands
    std::vector<std::string> words; ///< of Word, all of them
    std::string doc;                ///< of Text, which says what it may be
};

/// Every key that `describe` visits with the values that `config` has.
std::vector<Key> keys_of(sim::RunConfig config);
/// Every part of a number set, likewise.
std::vector<Key> keys_of(NumberSet set);

} // namespace degs::trials
