// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace degs::sim {

/// Adds `pack` to the command `workload`.
void add_pack_command(CLI::App& workload);

} // namespace degs::sim
