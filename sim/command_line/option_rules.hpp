// SPDX-License-Identifier: Apache-2.0
// Which options of a command go together: one table, from which command lines are refused, help and
// manual say what is allowed, and completions leave out what is not.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace degs::sim {

/// An option of a command line, or one of its values.
struct OptionTerm {
    std::string option; ///< "--trace"; of an argument its name, "config"
    std::string value;  ///< what counts, or what counts in front of a colon; empty: any value
    bool other = false; ///< every value but this one counts
};

struct OptionRule {
    std::vector<std::string> commands; ///< "run", "scene info"; empty: all that have the options
    std::vector<OptionTerm> options;   ///< each of them; empty: the command itself
    bool needs = false;                ///< one of `others` at least; else none of them is allowed
    std::vector<OptionTerm> others;
    std::string reason; ///< a verb, whose subject is the option: "needs every tile"
    std::string beside; ///< the rule counts only where this option is, too; empty: always
};

/// All rules of all commands.
const std::vector<OptionRule>& option_rules();

/// The rules of a command, with those of its options that it `has`.
std::vector<OptionRule> rules_of(const std::string& command,
                                 const std::function<bool(const std::string& option)>& has);

/// "--trace", "CONFIG", "--fidelity analytic", "--frames other than 1"
std::string words_of(const OptionTerm& term);
/// "--trace, --maps", "degs scene tile": whom the rule is for; `command` is the whole name.
std::string heading(const OptionRule& rule, const std::string& command);
/// "not with --within, --fidelity sampled; each needs every tile"
std::string explanation(const OptionRule& rule);

/// What cannot follow while something else stands on the line.
struct OptionConflict {
    OptionTerm typed, hidden;
};
std::vector<OptionConflict> conflicts_in(const std::vector<OptionRule>& rules);

} // namespace degs::sim
