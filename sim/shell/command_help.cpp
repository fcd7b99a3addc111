// SPDX-License-Identifier: Apache-2.0
// degs help: the commands and options of the program, for people, man and shells.
#include <memory>

#include <CLI/CLI.hpp>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/command_line/bash_completion.hpp"
#include "sim/command_line/help_text.hpp"
#include "sim/command_line/manual_page.hpp"
#include "sim/command_line/zsh_completion.hpp"
#include "sim/shell/commands.hpp"
#include "sim/text/standard_output.hpp"

namespace degs::sim {
namespace {

struct HelpOptions {
    std::vector<std::string> command;
    bool manual = false;
    bool bash_completion = false;
    bool zsh_completion = false;
};

const CLI::App& find_command(const CLI::App& program, const std::vector<std::string>& words) {
    const CLI::App* command = &program;
    for (const std::string& word : words) {
        std::vector<std::string> names;
        const CLI::App* found = nullptr;
        for (const CLI::App* below :
             command->get_subcommands([](const CLI::App*) { return true; })) {
            names.push_back(below->get_name());
            found = below->get_name() == word ? below : found;
        }
        if (found == nullptr) {
            const std::string meant = config_words::nearest(word, names);
            throw InputError(
                "There is no command " + config_words::quote(word) + " of '" + command->get_name() +
                "'" + (meant.empty() ? "" : ", did you mean " + config_words::quote(meant) + "?") +
                (names.empty() ? "." : " (allowed: " + config_words::list(names) + ")."));
        }
        command = found;
    }
    return *command;
}

std::vector<std::string> synthetic_names() {
    std::vector<std::string> names;
    for (const SyntheticProfile& profile : synthetic_profiles()) {
        names.push_back(profile.name);
    }
    return names;
}

void run(const CLI::App& program, const HelpOptions& options) {
    if (options.manual) {
        print(manual_page(describe(program)));
    } else if (options.bash_completion) {
        print(bash_completion(describe(program), synthetic_names()));
    } else if (options.zsh_completion) {
        print(zsh_completion(describe(program), synthetic_names()));
    } else {
        print(help_text(find_command(program, options.command)));
    }
}

} // namespace

void add_help_command(CLI::App& program) {
    auto options = std::make_shared<HelpOptions>();
    CLI::App* command =
        program.add_subcommand("help", "explain the program or a command: degs help scene info");
    command->add_option("command", options->command, "words of a command")->type_name("COMMAND");
    command->add_flag("--man", options->manual, "print the manual page (roff)");
    command->add_flag("--bash-completion", options->bash_completion,
                      "print what bash needs to complete commands, options and values");
    command->add_flag("--zsh-completion", options->zsh_completion, "print the same for zsh");
    command->callback([options, &program] { run(program, *options); });
}

} // namespace degs::sim
