// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/help_text.hpp"

#include <sstream>

#include "sim/command_line/option_tree.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kColumn = 26; ///< where explanations begin
constexpr std::size_t kWidth = 80;

/// Two columns; a long first one gets lines of its own.
std::string entry(const std::string& what, const std::string& meaning) {
    std::string line = "  " + wrapped(what, 4, kWidth - 4);
    if (characters(line) + 2 > kColumn) {
        line += "\n" + std::string(kColumn, ' ');
    } else {
        line.append(kColumn - characters(line), ' ');
    }
    return line + wrapped(meaning, kColumn, kWidth - kColumn) + "\n";
}

std::string entries(const std::vector<OptionEntry>& options, bool arguments) {
    std::string text;
    for (const OptionEntry& option : options) {
        if (option.argument == arguments) {
            text += entry(heading(option), explanation(option));
        }
    }
    return text;
}

/// Which options go together, each rule once.
std::string combinations(const CommandEntry& command) {
    std::string text;
    for (const OptionRule& rule : command.rules) {
        text += entry(heading(rule, command.path), explanation(rule));
    }
    return text.empty() ? "" : "\nCombinations:\n" + text;
}

} // namespace

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
    std::istringstream words(text);
    std::string lines;
    std::size_t column = 0;
    for (std::string word; words >> word;) {
        if (column != 0 && column + 1 + characters(word) > width) {
            lines += "\n" + std::string(indent, ' ');
            column = 0;
        }
        lines += (column == 0 ? "" : " ") + word;
        column += characters(word) + (column == 0 ? 0 : 1);
    }
    return lines;
}

std::string help_text(const CLI::App& command) {
    const CommandEntry described = describe(command);
    std::string text = wrapped(described.path + ": " + described.meaning, 2, kWidth) +
                       "\nUsage: " + usage(described) + "\n";
    const std::string arguments = entries(described.options, true);
    text += (arguments.empty() ? "" : "\n") + arguments;
    if (!described.commands.empty()) {
        text += "\nCommands:\n";
        for (const CommandEntry& below : described.commands) {
            text += entry(below.name(), below.meaning);
        }
    }
    return text + "\nOptions:\n" + entries(described.options, false) + combinations(described);
}

} // namespace degs::sim
