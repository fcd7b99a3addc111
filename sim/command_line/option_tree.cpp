// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/option_tree.hpp"

#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

#include "config/config_words.hpp"
#include "sim/text/comma_parts.hpp"

namespace degs::sim {
namespace {

using Words = std::vector<std::string>;

std::string in_capitals(std::string word) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return word;
}

/// Part of `text` between the marks; empty without them.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin);
    const std::size_t to = text.find(end, from);
    return from == std::string::npos || to == std::string::npos
               ? std::string()
               : text.substr(from + begin.size(), to - from - begin.size());
}

/// The library writes a type as "TEXT:{exact,strict}" or "INT:INT in [1 - 64]".
Words choices_of(const std::string& type) {
    const std::string list = between(type, "{", "}");
    return list.empty() ? Words() : comma_parts(list);
}

std::string range_in(const std::string& type) {
    std::string range = between(type, " in [", "]");
    const std::size_t dash = range.find(" - ");
    return dash == std::string::npos ? "" : range.replace(dash, 3, " to ");
}

void note(Words& notes, const std::string& before, const std::string& words) {
    if (!words.empty()) {
        notes.push_back(before + words);
    }
}

Words notes_of(const CLI::Option& option, const std::string& type) {
    Words notes;
    if (option.get_required()) {
        notes.emplace_back("required");
    }
    note(notes, "", range_in(type));
    std::string fallback = option.get_default_str();
    fallback.erase(std::remove_if(fallback.begin(), fallback.end(),
                                  [](char c) { return c == '[' || c == ']' || c == '"'; }),
                   fallback.end());
    note(notes, "default ", fallback);
    return notes;
}

OptionEntry describe_option(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    OptionEntry entry;
    entry.argument = option.get_positional();
    entry.required = option.get_required();
    entry.several = entry.argument
                        ? option.get_expected_max() > 1
                        : option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    if (entry.argument) {
        entry.names = {in_capitals(option.get_name(true))};
    } else {
        for (const std::string& letter : option.get_snames()) {
            entry.names.push_back("-" + letter);
        }
        for (const std::string& name : option.get_lnames()) {
            entry.names.push_back("--" + name);
        }
    }
    entry.value = option.get_type_size() == 0 ? "" : type.substr(0, type.find(':'));
    entry.choices = choices_of(type);
    entry.meaning = option.get_description();
    entry.notes = notes_of(option, type);
    return entry;
}

} // namespace

std::string path_of(const CLI::App& command) {
    return command.get_parent() == nullptr
               ? command.get_name()
               : path_of(*command.get_parent()) + " " + command.get_name();
}

std::vector<OptionRule> rules_of(const CLI::App& command) {
    const std::string path = path_of(command);
    return rules_of(path.substr(path.find(' ') + 1), [&command](const std::string& option) {
        return command.get_option_no_throw(option) != nullptr;
    });
}

CommandEntry describe(const CLI::App& command) {
    CommandEntry entry;
    entry.path = path_of(command);
    entry.meaning = command.get_description();
    for (const CLI::Option* option : command.get_options()) {
        entry.options.push_back(describe_option(*option));
    }
    std::stable_partition(entry.options.begin(), entry.options.end(),
                          [](const OptionEntry& option) { return option.argument; });
    entry.rules = rules_of(command);
    for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; })) {
        entry.commands.push_back(describe(*below));
    }
    return entry;
}

std::string usage(const CommandEntry& command) {
    std::string words = command.path + " [OPTIONS]";
    for (const OptionEntry& option : command.options) {
        if (option.argument) {
            const std::string name = option.names.front() + (option.several ? "..." : "");
            words += option.required ? " " + name : " [" + name + "]";
        }
    }
    return words + (command.commands.empty() ? "" : " COMMAND");
}

std::string heading(const OptionEntry& option) {
    std::string words = config_words::list(option.names);
    if (!option.argument && !option.value.empty()) {
        words += " ";
        for (const std::string& choice : option.choices) {
            words += (choice == option.choices.front() ? "" : "|") + choice;
        }
        words += option.choices.empty() ? option.value : "";
    }
    return words;
}

std::string explanation(const OptionEntry& option) {
    std::string notes;
    for (const std::string& each : option.notes) {
        notes += (notes.empty() ? "" : "; ") + each;
    }
    return option.meaning + (notes.empty() ? "" : " [" + notes + "]");
}

} // namespace degs::sim
