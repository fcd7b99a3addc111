// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/App.hpp>

namespace degs::sim {

/// The file that a command writes a scene to: its last argument, or --out. `extensions` are those
/// that can be written.
void add_scene_out(CLI::App& command, std::string& out, const std::string& extensions);

} // namespace degs::sim
