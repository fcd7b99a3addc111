// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sim/command_line/option_tree.hpp"

namespace degs::sim {

/// A script that makes bash complete commands, options, values, files, folders and the names of
/// `synthetic` scenes. It needs nothing but bash.
std::string bash_completion(const CommandEntry& program, const std::vector<std::string>& synthetic);

} // namespace degs::sim
