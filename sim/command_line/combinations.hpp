// SPDX-License-Identifier: Apache-2.0
// These functions refuse options that the rules do not allow together. They do not know CLI11,
// because the keys of a study stand for options, too, and obey the same rules.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/command_line/option_rules.hpp"

namespace degs::sim {

/// What is known of an option.
struct OptionState {
    bool given = false;
    std::string value{};  ///< its default if it was not given
    std::string origin{}; ///< where it may come from as well, for the message; empty: nowhere
};
using OptionStates = std::function<OptionState(const std::string& option)>;

/// Throws InputError, one sentence with the reason, if one of the rules is broken; `command` is
/// "degs run".
void refuse_combinations(const std::string& command, const std::vector<OptionRule>& rules,
                         const OptionStates& states);

} // namespace degs::sim
