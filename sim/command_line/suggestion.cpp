// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/suggestion.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "config/config_words.hpp"
#include "sim/command_line/option_tree.hpp"

namespace degs::sim {
namespace {

/// The command that the words lead to, as far as they are known.
const CLI::App& command_of(const CLI::App& program) {
    const CLI::App* command = &program;
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().back();
    }
    return *command;
}

std::vector<std::string> candidates_for(const std::string& word, const CommandEntry& command) {
    std::vector<std::string> candidates;
    if (word.front() == '-') {
        for (const OptionEntry& option : command.options) {
            candidates.insert(candidates.end(), option.names.begin(), option.names.end());
        }
    } else {
        for (const CommandEntry& below : command.commands) {
            candidates.push_back(below.name());
        }
    }
    return candidates;
}

/// The commands that have the option: "run, sweep".
std::string commands_with(const std::string& option, const CommandEntry& program) {
    std::vector<std::string> names;
    for (const CommandEntry& command : program.commands) {
        const std::vector<std::string> options = candidates_for(option, command);
        if (std::find(options.begin(), options.end(), option) != options.end()) {
            names.push_back(command.name());
        }
    }
    return config_words::list(names);
}

/// `word` is what the library could not use.
std::string unexpected(const std::string& word, const CLI::App& program, const CLI::App& command) {
    const std::string name = word.substr(0, word.find('=')); // --camera=2
    const std::string meant =
        name.empty() ? "" : config_words::nearest(name, candidates_for(name, describe(command)));
    const std::string start = config_words::quote(word) + " is not expected here";
    if (!meant.empty()) {
        return start + ", did you mean " + config_words::quote(meant) + "?";
    }
    const std::string others =
        name.rfind("--", 0) == 0 ? commands_with(name, describe(program)) : "";
    return start + (others.empty() ? "" : "; it is an option of " + others) + ".";
}

} // namespace

std::string explain_mistake(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App& command = command_of(program);
    std::string reason = error.what();
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) {
        reason.pop_back();
    }
    reason += ".";
    // The library misses a command or option before it looks at what stands in its place.
    if (const auto extras = program.remaining(true); !extras.empty()) {
        reason = unexpected(extras.front(), program, command);
    }
    const std::string path = path_of(command);
    const std::string help =
        path.substr(0, path.find(' ')) + " help" +
        (path.find(' ') == std::string::npos ? "" : path.substr(path.find(' ')));
    return reason + " '" + help + "' lists what is allowed.";
}

} // namespace degs::sim
