// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sim/command_line/option_tree.hpp"

namespace degs::sim {

/// A script that makes zsh complete commands, options, values, files, folders and the names of
/// `synthetic` scenes, with their meanings. It is found as `_degs` in a folder of $fpath, or read
/// with `source` after compinit. It needs nothing but the completion functions of zsh.
std::string zsh_completion(const CommandEntry& program, const std::vector<std::string>& synthetic);

} // namespace degs::sim
