// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/given_options.hpp"

#include <CLI/CLI.hpp>

#include "sim/command_line/combinations.hpp"
#include "sim/command_line/option_tree.hpp"

namespace degs::sim {
namespace {

OptionState state_of(const CLI::App& command, const std::string& name) {
    const CLI::Option* const option = command.get_option_no_throw(name);
    OptionState state;
    if (option != nullptr) {
        state.given = option->count() > 0;
        state.value = state.given && !option->results().empty() ? option->results().back()
                                                                : option->get_default_str();
    }
    return state;
}

} // namespace

void refuse_combinations(const CLI::App& command) {
    if (!command.remaining().empty()) {
        return; // a word that the library does not know may be a misspelt option that is needed
    }
    refuse_combinations(path_of(command), rules_of(command),
                        [&command](const std::string& name) { return state_of(command, name); });
}

} // namespace degs::sim
