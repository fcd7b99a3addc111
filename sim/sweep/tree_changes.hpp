// SPDX-License-Identifier: Apache-2.0
// What the axes of a study put into the tree of a design.
#pragma once

#include <string>

#include "config/config_tree.hpp"

namespace degs::sim {

/// Puts a value into a tree as --set would: nothing in the files overrides it.
void put_value(ConfigNode& tree, const std::string& path, const std::string& text,
               const std::string& place);

/// Puts the values of a file, given by its tree, into a section as if its own `include` named that
/// file and the section nothing else: of what the section had before, only values that the file
/// does not name stay.
void put_section(ConfigNode& tree, const std::string& path, const ConfigNode& file,
                 const std::string& place);

} // namespace degs::sim
