// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "splat/number_set.hpp"
#include "tlm/config.hpp"

namespace degs {

/// Single parts of a number set that a configuration changes; keys are those of number_keys().
class FormatsConfig {
public:
    FormatsConfig();
    void describe(ConfigVisitor& visitor);
    /// The set of that name with the changes; nothing if there are none. InputError if the parts do
    /// not fit together.
    std::optional<NumberSet> applied_to(const std::string& set) const;

private:
    bool any() const;
    std::vector<std::string> values_; // in the order of number_keys(); "set" where nothing changes
};

} // namespace degs
