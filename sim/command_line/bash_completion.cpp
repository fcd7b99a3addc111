// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/bash_completion.hpp"

#include "sim/command_line/completion_rules.hpp"

namespace degs::sim {
namespace {

using Words = std::vector<std::string>;

std::string strung(const Words& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : between) + word;
    }
    return text;
}

/// A line of a case: patterns, and the assignment behind them.
std::string branch(const Words& patterns, const std::string& sets) {
    Words quoted;
    for (const std::string& pattern : patterns) {
        quoted.push_back("'" + pattern + "'");
    }
    return "        " + strung(quoted, " | ") + ") " + sets + " ;;\n";
}

/// The assignment for the words, or the kind of word, that a value or argument may be.
std::string sets_of(const OptionEntry& option) {
    if (!option.choices.empty()) {
        return "words='" + strung(option.choices, " ") + "'";
    }
    if (option.value == "FILE" || option.value == "FOLDER" || option.value == "SCENE") {
        return "kind=" + option.value;
    }
    return option.value == "COMMAND" ? "words=$commands" : "kind=NONE";
}

/// The branches of the commands below `command`, for the cases of the script.
struct Branches {
    Words paths;
    std::string values;  ///< by command and option in front of the word
    std::string options; ///< by command, if the word begins with '-'
    std::string others;  ///< by command: commands below, or the argument
    std::string hidden;  ///< by command: what does not go with the options that are there
};

/// The branch of a command whose options do not all go together.
std::string hidden_branch(const CommandEntry& command) {
    std::string tests;
    for (const LeftOut& each : left_out(command, "@(")) {
        tests +=
            "            [[ " + each.test + " ]] && hidden+=' " + strung(each.words, " ") + "'\n";
    }
    return tests.empty() ? "" : "        '" + command.path + "')\n" + tests + "            ;;\n";
}

void add(const CommandEntry& command, Branches& branches) {
    Words names;
    std::string argument;
    for (const OptionEntry& option : command.options) {
        if (option.argument) {
            argument = argument.empty() ? sets_of(option) : argument;
            continue;
        }
        names.insert(names.end(), option.names.begin(), option.names.end());
        if (!option.value.empty()) {
            Words patterns;
            for (const std::string& name : option.names) {
                patterns.push_back(command.path + " " + name);
            }
            branches.values += branch(patterns, sets_of(option));
        }
    }
    branches.options += branch({command.path}, "words='" + strung(names, " ") + "'");
    branches.hidden += hidden_branch(command);
    Words below;
    for (const CommandEntry& each : command.commands) {
        below.push_back(each.name());
        branches.paths.push_back(each.path);
        add(each, branches);
    }
    if (!below.empty()) {
        argument = "words='" + strung(below, " ") + "'";
    }
    branches.others += argument.empty() ? "" : branch({command.path}, argument);
}

constexpr const char* kAnswer = R"(
    local word kept=
    for word in $words; do
        [[ " $hidden " == *" $word "* || " $hidden " == *" $before=$word "* ]] || kept+=" $word"
    done
    words=$kept
    local reply
    COMPREPLY=()
    while IFS= read -r reply; do
        COMPREPLY+=("$reply")
    done < <(
        case $kind in
            NONE) ;;
            FILE) compgen -f -- "$current" ;;
            FOLDER) compgen -d -- "$current" ;;
            SCENE) compgen -f -- "$current"; compgen -W "$synthetic" -- "$current" ;;
            *) compgen -W "$words" -- "$current" ;;
        esac
    )
    case $kind in
        FILE | FOLDER | SCENE) compopt -o filenames 2>/dev/null ;;
    esac
}
complete -F _degs degs
)";

} // namespace

std::string bash_completion(const CommandEntry& program, const Words& synthetic) {
    Branches branches;
    add(program, branches);
    Words commands;
    for (const CommandEntry& command : program.commands) {
        commands.push_back(command.name());
    }
    Words scenes;
    for (const std::string& name : synthetic) {
        scenes.push_back("synthetic:" + name);
    }
    return "# bash completion of degs, made by 'degs help --bash-completion'\n"
           "_degs() {\n"
           "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
           "    local command=" +
           program.name() +
           " words= kind= i\n"
           "    local commands='" +
           strung(commands, " ") +
           "'\n"
           "    local synthetic='" +
           strung(scenes, " ") +
           "'\n"
           "    # bash takes ':' for the end of a word\n"
           "    if [[ $current == : && $before == synthetic ]]; then\n"
           "        current= before=:\n"
           "    fi\n"
           "    if [[ $before == : && ${COMP_WORDS[*]:0:COMP_CWORD + 1} == *synthetic\\ :* ]]; "
           "then\n"
           "        COMPREPLY=($(compgen -W '" +
           strung(synthetic, " ") +
           "' -- \"$current\"))\n"
           "        return\n"
           "    fi\n"
           "    for ((i = 1; i < COMP_CWORD; i++)); do\n"
           "        case \"$command ${COMP_WORDS[i]}\" in\n" +
           branch(branches.paths, "command+=\" ${COMP_WORDS[i]}\"") +
           "        esac\n"
           "    done\n"
           "    case \"$command $before\" in\n" +
           branches.values +
           "    esac\n"
           "    if [[ -z $kind$words && $current == -* ]]; then\n"
           "        case $command in\n" +
           branches.options +
           "        esac\n"
           "    elif [[ -z $kind$words ]]; then\n"
           "        case $command in\n" +
           branches.others +
           "        esac\n"
           "    fi\n"
           "    local typed=\" ${COMP_WORDS[*]:1:COMP_CWORD - 1} \" hidden=\n"
           "    typed=${typed// = / } # bash takes '=' for a word\n"
           "    case $command in\n" +
           branches.hidden + "    esac" + kAnswer;
}

} // namespace degs::sim
