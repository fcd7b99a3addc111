// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sim/command_line/option_tree.hpp"

namespace degs::sim {

/// The page degs(1) in the language of man(7).
std::string manual_page(const CommandEntry& program);

} // namespace degs::sim
