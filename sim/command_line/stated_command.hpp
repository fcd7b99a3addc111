// SPDX-License-Identifier: Apache-2.0
// The command that a result states as the one that made it.
#pragma once

#include <functional>
#include <string>

#include <CLI/App.hpp>

namespace degs::sim {

/// What the parsed arguments of a command ask for, from its name on, as a shell takes it:
/// "degs sweep study.yaml --width 64" for the program, without "degs" for its command. Positional
/// arguments come first, options in the order of the help. Options that say where results go, who
/// runs what, or what a terminal shows are left out, so that all commands with the same results
/// state the same.
std::string stated_command(const CLI::App& command);

/// Calls `use` with the command whose arguments have been parsed, before it begins.
void when_parsed(CLI::App& program, const std::function<void(const CLI::App&)>& use);

} // namespace degs::sim
