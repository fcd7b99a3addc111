// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs::sim {

/// A word of a shell command, in quotes if it must be.
std::string shell_word(const std::string& word);

} // namespace degs::sim
