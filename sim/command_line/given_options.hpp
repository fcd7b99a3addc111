// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace degs::sim {

/// Throws InputError, one sentence with the reason, if the options of a command that have been
/// parsed break one of its rules.
void refuse_combinations(const CLI::App& command);

} // namespace degs::sim
