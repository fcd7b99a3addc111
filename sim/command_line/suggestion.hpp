// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/App.hpp>

namespace degs::sim {

/// Why a command line that the library refused with `error` cannot be followed: one or two
/// sentences, with the command or option that a misspelt word probably means.
std::string explain_mistake(const CLI::App& program, const CLI::ParseError& error);

} // namespace degs::sim
