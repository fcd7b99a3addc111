// SPDX-License-Identifier: Apache-2.0
// What completions of a shell leave out because of the options that stand on the line.
#pragma once

#include <string>
#include <vector>

#include "sim/command_line/option_tree.hpp"

namespace degs::sim {

/// What is left out while something stands on the line.
struct LeftOut {
    std::string test; ///< condition of the shell, about the words in front in the variable `typed`
    std::vector<std::string> words; ///< "--trace", and "--fidelity=analytic" for a value
};

/// `group` is how a group of alternatives begins in a pattern of the shell.
std::vector<LeftOut> left_out(const CommandEntry& command, const std::string& group);

} // namespace degs::sim
