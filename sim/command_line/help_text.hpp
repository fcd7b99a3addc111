// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <CLI/App.hpp>

namespace degs::sim {

/// What --help prints for a command, in lines of at most 80 characters wherever words allow it.
std::string help_text(const CLI::App& command);

/// `text` in lines of at most `width` characters, each after the first indented by `indent`; words
/// are not broken.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width);

} // namespace degs::sim
