// SPDX-License-Identifier: Apache-2.0
// Commands and options of the program as data, from which help, manual and completion are made.
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "sim/command_line/option_rules.hpp"

namespace degs::sim {

/// An option, or an argument without a name of its own on the command line.
struct OptionEntry {
    std::vector<std::string> names;   ///< "-h" and "--help"; of an argument "CONFIG"
    std::string value;                ///< what follows: "FILE", "INT"; empty: nothing
    std::vector<std::string> choices; ///< the allowed values; empty: any
    std::string meaning;
    std::vector<std::string> notes; ///< "required", "default 1", "1 to 64"
    bool argument = false;
    bool required = false;
    bool several = false; ///< an argument of several words, an option that may be repeated
};

struct CommandEntry {
    std::string path; ///< "degs scene info"
    std::string meaning;
    std::vector<OptionEntry> options; ///< arguments first
    std::vector<OptionRule> rules;    ///< which of the options go together
    std::vector<CommandEntry> commands;

    std::string name() const { return path.substr(path.rfind(' ') + 1); }
};

/// "degs scene info"
std::string path_of(const CLI::App& command);
/// The rules of the options of a command, which are of its name below the program.
std::vector<OptionRule> rules_of(const CLI::App& command);
/// `command` and all below it.
CommandEntry describe(const CLI::App& command);

/// "degs scene info [OPTIONS] SCENE"
std::string usage(const CommandEntry& command);
/// "--camera-file, --cameras FILE"
std::string heading(const OptionEntry& option);
/// The meaning, then the notes in brackets.
std::string explanation(const OptionEntry& option);

} // namespace degs::sim
