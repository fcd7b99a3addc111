// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace degs::sim {

/// Adds `tile` to the command `scene`.
void add_scene_tile(CLI::App& scene);

} // namespace degs::sim
