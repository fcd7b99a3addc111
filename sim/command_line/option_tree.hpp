// SPDX-License-Identifier: Apache-2.0
// Commands and options of the program as data, from which help, manual and completion are made.
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

namespace degs::sim {

/// An option, or an argument without a name of its own on the command line.
struct OptionEntry {
    std::vector<std::string> names;   ///< "-h" and "--help"; of an argument "CONFIG"
    std::string value;                ///< what follows: "FILE", "INT"; empty: nothing
    std::vector<std::string> choices; ///< the allowed values; empty: any
    std::string meaning;
    std::vector<std::string> notes; ///< "required", "default 1", "1 to 64", "not with --width"
    bool argument = false;
    bool required = false;
    bool several = false; ///< an argument of several words, an option that may be repeated
};

struct CommandEntry {
    std::string path; ///< "degs scene info"
    std::string meaning;
    std::vector<OptionEntry> options; ///< arguments first
    std::vector<CommandEntry> commands;

    std::string name() const { return path.substr(path.rfind(' ') + 1); }
};

/// `command` and all below it; `above` is the path of the command that it belongs to.
CommandEntry describe(const CLI::App& command, const std::string& above = "");

/// "degs scene info [OPTIONS] SCENE"
std::string usage(const CommandEntry& command);
/// "--camera-file, --cameras FILE"
std::string heading(const OptionEntry& option);
/// The meaning, then the notes in brackets.
std::string explanation(const OptionEntry& option);

} // namespace degs::sim
