// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/stated_command.hpp"

#include <algorithm>
#include <array>

#include <CLI/CLI.hpp>

#include "sim/text/shell_word.hpp"

namespace degs::sim {
namespace {

constexpr std::array<const char*, 10> kWithoutEffect{
    "--out", "--jobs",  "--shard", "--patience", "--sort",
    "--top", "--slurm", "--tasks", "--sbatch",   "--collect"};

bool has_effect(const CLI::Option& option) {
    return std::none_of(kWithoutEffect.begin(), kWithoutEffect.end(),
                        [&option](const char* name) { return option.check_name(name); });
}

/// " --width 64", with a value that looks like an option in one word.
std::string words_of(const CLI::Option& option) {
    const std::string name = option.get_name();
    if (option.get_items_expected_max() == 0) { // a flag, which --quick=false takes back
        return option.as<bool>() ? " " + name : "";
    }
    std::string text;
    for (const std::string& value : option.results()) {
        const bool dashed = value.rfind('-', 0) == 0;
        text += ' ';
        if (option.get_positional()) {
            text += shell_word(dashed ? "./" + value : value);
        } else if (dashed) {
            std::string both = name;
            text += shell_word(both.append("=").append(value));
        } else {
            text += name;
            text += ' ';
            text += shell_word(value);
        }
    }
    return text;
}

void add_words(const CLI::App& command, std::string& text) {
    text += (text.empty() ? "" : " ") + command.get_name();
    for (const bool positional : {true, false}) {
        for (const CLI::Option* option : command.get_options()) {
            if (option->count() > 0 && option->get_positional() == positional &&
                has_effect(*option)) {
                text += words_of(*option);
            }
        }
    }
    for (const CLI::App* below : command.get_subcommands()) {
        add_words(*below, text);
    }
}

} // namespace

std::string stated_command(const CLI::App& command) {
    std::string text;
    add_words(command, text);
    return text;
}

void when_parsed(CLI::App& program, const std::function<void(const CLI::App&)>& use) {
    const std::function<void(CLI::App&)> watch = [&](CLI::App& command) {
        for (CLI::App* below : command.get_subcommands({})) {
            below->parse_complete_callback([below, use] { use(*below); });
            watch(*below);
        }
    };
    watch(program);
}

} // namespace degs::sim
