// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/completion_rules.hpp"

#include <algorithm>

namespace degs::sim {
namespace {

/// All names of an option; none for an argument, which has no name on the line.
std::vector<std::string> names_in(const CommandEntry& command, const std::string& option) {
    for (const OptionEntry& entry : command.options) {
        const std::vector<std::string>& names = entry.names;
        if (std::find(names.begin(), names.end(), option) != names.end()) {
            return names;
        }
    }
    return {};
}

/// Empty for what leaves no name on the line.
std::string test_of(const std::vector<std::string>& names, const OptionTerm& term,
                    const std::string& group) {
    std::string either;
    for (const std::string& name : names) {
        either += (either.empty() ? group : "|") + name;
    }
    if (either.empty()) {
        return "";
    }
    const std::string name = "*' '" + either + ")' ";
    const std::string with = name + term.value + "'[\\ :]*";
    const std::string any = "$typed == " + name + "'*";
    return term.value.empty() ? any
           : term.other       ? any + " && $typed != " + with
                              : "$typed == " + with;
}

std::vector<std::string> words_of(const std::vector<std::string>& names, const OptionTerm& term) {
    std::vector<std::string> words;
    for (const std::string& name : term.other ? std::vector<std::string>() : names) {
        words.push_back(name + (term.value.empty() ? "" : "=" + term.value));
    }
    return words;
}

} // namespace

std::vector<LeftOut> left_out(const CommandEntry& command, const std::string& group) {
    std::vector<LeftOut> all;
    for (const OptionConflict& conflict : conflicts_in(command.rules)) {
        const OptionTerm& typed = conflict.typed;
        const std::string test = test_of(names_in(command, typed.option), typed, group);
        const std::vector<std::string> words =
            words_of(names_in(command, conflict.hidden.option), conflict.hidden);
        if (test.empty() || words.empty()) {
            continue;
        }
        auto found = std::find_if(all.begin(), all.end(),
                                  [&test](const LeftOut& each) { return each.test == test; });
        if (found == all.end()) {
            found = all.insert(all.end(), LeftOut{test, {}});
        }
        found->words.insert(found->words.end(), words.begin(), words.end());
    }
    return all;
}

} // namespace degs::sim
