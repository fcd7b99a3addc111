// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace degs::sim {

/// Adds sentences about the design or scene that is called `name`, each once.
void add_warnings(std::vector<std::string>& all, const std::string& name,
                  const std::vector<std::string>& sentences);
/// Prints them on stderr.
void print_warnings(const std::vector<std::string>& warnings);

} // namespace degs::sim
