// SPDX-License-Identifier: Apache-2.0
// Each function adds one command to the program; the command runs when its arguments are parsed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/App.hpp> // all of CLI11 costs another 3 s per source; program.cpp has it

namespace degs::sim {

void add_run_command(CLI::App& program);
void add_compare_command(CLI::App& program);
void add_sweep_command(CLI::App& program);
void add_explore_command(CLI::App& program);
void add_bandwidth_command(CLI::App& program);
void add_buffers_command(CLI::App& program);
void add_motion_command(CLI::App& program);
void add_render_command(CLI::App& program);
void add_scene_command(CLI::App& program);
void add_memory_command(CLI::App& program);
void add_workload_command(CLI::App& program);
void add_soc_command(CLI::App& program);
void add_config_command(CLI::App& program);
void add_accuracy_command(CLI::App& program);
void add_registers_command(CLI::App& program);
/// The program, whose commands and options are there and whose arguments have not come.
using PreparedProgram = std::function<int(int argc, char* argv[])>;
/// The forks of the server run what `prepare` makes once.
void add_serve_command(CLI::App& program, const std::function<PreparedProgram()>& prepare);
/// Describes what the other functions have added.
void add_help_command(CLI::App& program);

/// `--set`, for commands that take one configuration file.
void add_overrides_option(
    CLI::App& command, std::vector<std::string>& overrides,
    const char* meaning = "path.to.key=value overrides the file; may be repeated");
/// `--set`, for commands that take several configuration files, whose designs have names.
void add_addressed_overrides_option(CLI::App& command, std::vector<std::string>& overrides);

} // namespace degs::sim
