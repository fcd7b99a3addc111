// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/zsh_completion.hpp"

#include <algorithm>

#include "sim/command_line/completion_rules.hpp"

namespace degs::sim {
namespace {

using ZshWords = std::vector<std::string>;

std::string spaced(const ZshWords& words) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : " ") + word;
    }
    return text;
}

/// `text` for the inside of single quotes, with a backslash before each of the characters
/// `special`.
std::string escaped(const std::string& text, const std::string& special) {
    std::string result;
    for (const char c : text) {
        if (c == '\'') {
            result += "'\\''";
        } else {
            result += (special.find(c) == std::string::npos ? "" : "\\") + std::string(1, c);
        }
    }
    return result;
}

/// "degs scene info" is completed by the function _degs_scene_info.
std::string function_of(const CommandEntry& command) {
    std::string name = "_" + command.path;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

/// The message and the action of _arguments for a value or argument. Choices are those of the
/// variable `choices` if it names one.
std::string action_of(const OptionEntry& option, const std::string& choices = "") {
    const std::string& kind = option.value;
    const std::string message = ":" + (option.argument ? option.names.front() : kind) + ":";
    if (!option.choices.empty()) {
        return message + "(" + (choices.empty() ? spaced(option.choices) : "$" + choices) + ")";
    }
    return message + (kind == "FILE"      ? "_files"
                      : kind == "FOLDER"  ? "_files -/"
                      : kind == "SCENE"   ? "__degs_scenes"
                      : kind == "COMMAND" ? "__degs_commands"
                                          : " ");
}

/// '(-h --help)'{-h,--help}'[Print this help]', or '--width[image width]:INT: '.
std::string spec_of(const OptionEntry& option, const std::string& choices) {
    const std::string tail = "'[" + escaped(explanation(option), "[]\\") + "]" +
                             (option.value.empty() ? "" : action_of(option, choices)) + "'";
    std::string names;
    for (const std::string& name : option.names) {
        names += (names.empty() ? "" : ",") + name;
    }
    if (option.names.size() > 1) {
        names = "{" + names + "}";
    }
    return (option.several ? "'*'" : "'(" + spaced(option.names) + ")'") + names + tail;
}

std::string argument_spec(const OptionEntry& option) {
    const char* count = option.required ? "" : ":";
    return std::string("'") + (option.several ? "*" : count) + action_of(option) + "'";
}

/// The tests of the command under which an option, or a value of it, is left out.
ZshWords tests_of(const ZshWords& words, const std::vector<LeftOut>& all) {
    ZshWords tests;
    for (const LeftOut& each : all) {
        if (std::find_first_of(each.words.begin(), each.words.end(), words.begin(), words.end()) !=
            each.words.end()) {
            tests.push_back(each.test);
        }
    }
    return tests;
}

std::string any_of(const ZshWords& tests) {
    std::string text;
    for (const std::string& test : tests) {
        text += (text.empty() ? "[[ " : " || [[ ") + test + " ]]";
    }
    return tests.size() > 1 ? "{ " + text + "; }" : text;
}

/// Lines that fill an array with the choices of an option, of which some may be left out; empty if
/// none is.
std::string choice_lines(const OptionEntry& option, const std::string& name,
                         const std::vector<LeftOut>& all) {
    std::string lines;
    for (const std::string& choice : option.choices) {
        const ZshWords tests = tests_of({option.names.front() + "=" + choice}, all);
        if (!tests.empty()) {
            lines.append("    ").append(any_of(tests)).append(" && ").append(name);
            lines.append("=(${").append(name).append(":#").append(choice).append("})\n");
        }
    }
    return lines.empty() ? ""
                         : "    local -a " + name + "=(" + spaced(option.choices) + ")\n" + lines;
}

/// Lines that fill the array `specs` for the options and arguments of a command.
std::string spec_lines(const CommandEntry& command) {
    const std::vector<LeftOut> all = left_out(command, "(");
    std::string lines = "    local -a specs\n";
    if (!all.empty()) {
        lines += "    local typed=\" ${(j: :)words[1,CURRENT-1]} \"\n    typed=${typed//=/ }\n";
    }
    for (const OptionEntry& option : command.options) {
        std::string choices = "choices_" + option.names.front().substr(2);
        std::replace(choices.begin(), choices.end(), '-', '_');
        const std::string narrowed = choice_lines(option, choices, all);
        const ZshWords tests = option.argument ? ZshWords() : tests_of(option.names, all);
        lines += narrowed + "    " + (tests.empty() ? "" : any_of(tests) + " || ") + "specs+=(" +
                 (option.argument ? argument_spec(option)
                                  : spec_of(option, narrowed.empty() ? "" : choices)) +
                 ")\n";
    }
    return lines;
}

/// The lines of _describe: names of commands with their meanings.
std::string described(const std::vector<CommandEntry>& commands) {
    std::string lines;
    for (const CommandEntry& command : commands) {
        lines += "        '" + escaped(command.name() + ":" + command.meaning, "\\") + "'\n";
    }
    return lines;
}

/// The function of a command without commands below, or that hands over to theirs.
std::string function_text(const CommandEntry& command) {
    const std::string head = function_of(command) + "() {\n";
    if (command.commands.empty()) {
        return head + spec_lines(command) + "    _arguments $specs\n}\n\n";
    }
    std::string text =
        head + "    local curcontext=$curcontext state\n    local -a line commands\n" +
        "    commands=(\n" + described(command.commands) + "    )\n" + spec_lines(command) +
        "    _arguments -C $specs \\\n        '1:command:->command' \\\n        "
        "'*::argument:->argument' "
        "&& return\n    case $state in\n"
        "        command) _describe command commands ;;\n"
        "        argument)\n            case $line[1] in\n";
    std::string below;
    for (const CommandEntry& each : command.commands) {
        text += "                " + each.name() + ") " + function_of(each) + " ;;\n";
        below += function_text(each);
    }
    return below + text + "            esac ;;\n    esac\n}\n\n";
}

} // namespace

std::string zsh_completion(const CommandEntry& program, const std::vector<std::string>& synthetic) {
    ZshWords scenes;
    for (const std::string& name : synthetic) {
        scenes.push_back("synthetic:" + name);
    }
    ZshWords commands;
    for (const CommandEntry& command : program.commands) {
        commands.push_back(command.name());
    }
    return "#compdef degs\n"
           "# zsh completion of degs, made by 'degs help --zsh-completion'\n\n"
           "__degs_synthetic() {\n    compadd \"$@\" -- " +
           spaced(scenes) +
           "\n}\n\n"
           "__degs_scenes() {\n"
           "    _alternative 'files:scene file:_files' 'scenes:synthetic scene:__degs_synthetic'\n"
           "}\n\n"
           "__degs_commands() {\n    compadd \"$@\" -- " +
           spaced(commands) + "\n}\n\n" + function_text(program) +
           "if [[ $funcstack[1] == _degs ]]; then\n"
           "    _degs \"$@\"\n"
           "else\n"
           "    compdef _degs degs\n"
           "fi\n";
}

} // namespace degs::sim
