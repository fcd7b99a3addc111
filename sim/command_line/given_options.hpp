// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace degs::sim {

/// Throws InputError, one sentence with the reason, if the options of a command that have been
/// parsed break one of its rules. A command with unknown words is left to the library, which
/// refuses them later.
void refuse_combinations(const CLI::App& command);

} // namespace degs::sim
