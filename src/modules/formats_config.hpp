// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config.hpp"

namespace degs {

/// Single parts of a number set that a configuration changes; keys are those of number_keys().
class FormatsConfig {
public:
    FormatsConfig();
    void describe(ConfigVisitor& visitor);
    /// The changes as "part=value".
    std::vector<std::string> assignments() const;

private:
    std::vector<std::string> values_; // in the order of number_keys(); "set" where nothing changes
};

} // namespace degs
