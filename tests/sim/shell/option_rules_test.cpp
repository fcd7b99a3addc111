// SPDX-License-Identifier: Apache-2.0
// Goes through the table of rules between options: the program refuses what breaks one, and its
// help says so.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "degs/error.hpp"
#include "sim/command_line/combinations.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using sim::OptionRule;
using sim::OptionState;
using sim::OptionTerm;
using Terms = std::vector<OptionTerm>;
using Words = std::vector<std::string>;

/// What each command needs before its rules are looked at.
const std::map<std::string, Words> kCommands{
    {"run", {"design.yaml"}},
    {"compare", {"design.yaml"}},
    {"sweep", {"study.yaml"}},
    {"explore", {"study.yaml"}},
    {"bandwidth", {"design.yaml"}},
    {"buffers", {"design.yaml"}},
    {"motion", {"design.yaml", "--scene", "synthetic:single"}},
    {"render", {"--scene", "synthetic:single"}},
    {"scene info", {"synthetic:single"}},
    {"scene cameras", {"synthetic:single"}},
    {"scene generate", {"single"}},
    {"scene convert", {"synthetic:single"}},
    {"scene tile", {"synthetic:single"}},
    {"memory", {"memory.yaml"}},
    {"workload export", {"design.yaml"}},
    {"workload pack", {"design.yaml", "--scene", "synthetic:single", "--out", "frame.degsw"}},
    {"soc", {"design.yaml", "--scene", "synthetic:single"}},
    {"config", {}},
    {"accuracy", {}},
    {"registers", {}},
    {"serve", {}},
    {"help", {}},
};

Words split_words(const std::string& text) {
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;) {
        words.push_back(word);
    }
    return words;
}

std::string in_one_line(const std::string& text) {
    std::string line;
    for (const std::string& word : split_words(text)) {
        line += (line.empty() ? "" : " ") + word;
    }
    return line;
}

std::string help_of(const std::string& command) {
    Words words{"help"};
    const Words names = split_words(command);
    words.insert(words.end(), names.begin(), names.end());
    return in_one_line(degs(words).out);
}

/// "--trace FILE", or the name of an argument in capitals, is a word of the help.
bool has_option(const std::string& help, const std::string& option) {
    const std::string word = option.front() == '-' ? option : sim::words_of(OptionTerm{option, ""});
    const std::string usage = help.substr(0, help.find(" Options: "));
    const Words all = split_words(option.front() == '-' ? help : usage);
    return std::any_of(all.begin(), all.end(), [&word](const std::string& each) {
        return each == word || each == word + ",";
    });
}

std::vector<OptionRule> rules_of(const std::string& command) {
    const std::string help = help_of(command);
    return sim::rules_of(command,
                         [&help](const std::string& option) { return has_option(help, option); });
}

const std::set<std::string> kFlags{
    "--explain",  "--array-only",      "--no-curve",      "--collect", "--list",       "--slurm",
    "--in-scene", "--single-gaussian", "--cost",          "--stats",   "--hard-cases", "--man",
    "--quick",    "--bash-completion", "--zsh-completion"};

/// What options take that do not take 1; for "every other value", one of those.
const std::map<std::string, Words> kValues{
    {"--views", {"0,1"}},        {"--foveation", {"0.5,0.5:10:20"}},
    {"--rules", {"khr"}},        {"--order", {"depth"}},
    {"--antialiasing", {"on"}},  {"--projection", {"linear"}},
    {"--lens", {"camera"}},      {"--block-log", {"bank:0", "log.csv"}},
    {"--budget", {"9"}},         {"--population", {"9"}},
    {"--diff", {"degs", "gbu"}}, {"--copies", {"2x2"}},
    {"--format", {"text"}},      {"--keys", {"own"}},
    {"--of", {"run"}},           {"--pattern", {"stream"}},
    {"--requests", {"1000"}},    {"--schema", {"design"}},
    {"config", {"degs"}},        {"command", {"run"}},
    {"out", {"scene.glb"}}};
const std::map<std::string, std::string> kOthers{
    {"--frames=1", "2"}, {"--between=0", "2"}, {"--of=run", "compare"}, {"--cpu=riscv", "host"}};

/// A term as words of a command line.
Words line_of(const OptionTerm& term) {
    Words words{term.option};
    if (term.option.front() != '-') {
        words.clear();
    }
    if (term.other) {
        words.push_back(kOthers.at(term.option + "=" + term.value));
    } else if (!term.value.empty()) {
        words.push_back(term.value == "sampled" ? "sampled:10%" : term.value);
    } else if (const auto value = kValues.find(term.option); value != kValues.end()) {
        words.insert(words.end(), value->second.begin(), value->second.end());
    } else if (kFlags.count(term.option) == 0) {
        words.emplace_back("1");
    }
    return words;
}

bool stands_in(const Terms& line, const OptionTerm& term) {
    return std::any_of(line.begin(), line.end(), [&term](const OptionTerm& each) {
        return each.option == term.option &&
               (term.value.empty() || (each.value == term.value && each.other == term.other));
    });
}

/// Adds what the terms of the line need, but for `rule`.
void add_needs(const std::vector<OptionRule>& rules, const OptionRule& rule, Terms& line) {
    for (const OptionRule& each : rules) {
        const auto stands = [&line](const OptionTerm& term) { return stands_in(line, term); };
        const bool counts =
            each.options.empty() || std::any_of(each.options.begin(), each.options.end(), stands);
        const bool met = std::any_of(each.others.begin(), each.others.end(), stands);
        if (each.needs && each.reason != rule.reason && counts && !met && each.beside.empty()) {
            line.push_back(each.others.front());
        }
    }
}

/// Each way to break the rule: an option and, if it must not stand with another, the other; where
/// it needs a value, another one, because the value may be the default.
std::vector<Terms> breaches_of(const OptionRule& rule) {
    const Terms others = rule.needs ? Terms{} : rule.others;
    std::vector<Terms> all;
    if (rule.options.empty()) {
        return {{}};
    }
    for (const OptionTerm& option : rule.options) {
        if (rule.needs) {
            const OptionTerm& needed = rule.others.front();
            all.push_back({option});
            if (!needed.value.empty()) {
                all.back().push_back({needed.option, needed.value, true});
            }
        }
        for (const OptionTerm& other : others) {
            all.push_back({option, other});
        }
    }
    return all;
}

Words program_line(const std::string& command, const Terms& terms) {
    Words line = split_words(command);
    const Words& more = kCommands.at(command);
    line.insert(line.end(), more.begin(), more.end());
    Words named;
    for (const OptionTerm& term : terms) {
        const Words words = line_of(term);
        Words& where = term.option.front() == '-' ? named : line; // arguments come first
        where.insert(where.end(), words.begin(), words.end());
    }
    line.insert(line.end(), named.begin(), named.end());
    return line;
}

class OptionRules : public ::testing::TestWithParam<std::pair<const std::string, Words>> {};

TEST_P(OptionRules, AreKeptByTheProgram) {
    const std::string& command = GetParam().first;
    const std::vector<OptionRule> rules = rules_of(command);
    for (const OptionRule& rule : rules) {
        for (Terms terms : breaches_of(rule)) {
            if (!rule.beside.empty()) {
                terms.push_back({rule.beside, ""});
            }
            add_needs(rules, rule, terms);
            const Words line = program_line(command, terms);
            SCOPED_TRACE(testing::PrintToString(line));
            expect_mistake(degs(line), rule.reason + ", so it " +
                                           (rule.needs ? "needs " : "cannot be combined with "));
        }
    }
}

TEST_P(OptionRules, StandInTheHelp) {
    const std::string& command = GetParam().first;
    const std::string help = help_of(command);
    for (const OptionRule& rule : rules_of(command)) {
        EXPECT_NE(help.find(sim::heading(rule, "degs " + command) + " " + sim::explanation(rule)),
                  std::string::npos)
            << sim::explanation(rule) << "\n"
            << help;
    }
}

INSTANTIATE_TEST_SUITE_P(Commands, OptionRules, ::testing::ValuesIn(kCommands),
                         [](const auto& command) {
                             std::string name = command.param.first;
                             std::replace(name.begin(), name.end(), ' ', '_');
                             return name;
                         });

/// Each option of each rule is one of a command that the rule is for.
TEST(OptionRuleTable, NamesOptionsThatAreThere) {
    std::map<std::string, std::string> helps;
    for (const auto& [command, more] : kCommands) {
        helps[command] = help_of(command);
    }
    for (const OptionRule& rule : sim::option_rules()) {
        Words commands = rule.commands;
        for (const auto& [command, help] : helps) {
            if (rule.commands.empty()) {
                commands.push_back(command);
            }
        }
        Terms terms = rule.options;
        terms.insert(terms.end(), rule.others.begin(), rule.others.end());
        for (const OptionTerm& term : terms) {
            EXPECT_TRUE(std::any_of(commands.begin(), commands.end(), [&](const std::string& each) {
                return has_option(helps.at(each), term.option);
            })) << term.option;
        }
    }
}

/// The sentence that refuses one pair of options.
std::string refusal_of(const OptionRule& rule, const std::map<std::string, OptionState>& states) {
    try {
        sim::refuse_combinations("degs x", {rule}, [&states](const std::string& option) {
            const auto found = states.find(option);
            return found == states.end() ? OptionState() : found->second;
        });
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(OptionRuleTable, SaysWhichOptionsARuleRefuses) {
    const OptionRule rule{{}, {{"--a", ""}, {"--n", "1", true}}, false, {{"--f", "v"}}, "is so",
                          ""};
    EXPECT_EQ(refusal_of(rule, {{"--a", {true}}, {"--f", {true, "v"}}}),
              "--a is so, so it cannot be combined with --f v.");
    EXPECT_EQ(refusal_of(rule, {{"--n", {true, "2"}}, {"--f", {true, "v:10%", "or 'f'"}}}),
              "--n is so, so it cannot be combined with --f v (or 'f').");
    EXPECT_EQ(refusal_of(rule, {{"--a", {true}}, {"--f", {true, "vv"}}}), "");
    EXPECT_EQ(refusal_of(rule, {{"--n", {true, "01"}}, {"--f", {true, "v"}}}), "");
    EXPECT_EQ(refusal_of(rule, {{"--n", {false, "1"}}, {"--f", {true, "v"}}}), "");
    EXPECT_EQ(refusal_of(rule, {{"--a", {true}}}), "");
    const OptionRule needs{{}, {{"--a", ""}}, true, {{"--f", "v"}, {"g", ""}}, "is so", "--b"};
    EXPECT_EQ(refusal_of(needs, {{"--a", {true}}, {"--b", {true}}}),
              "--a beside --b is so, so it needs --f v or G.");
    EXPECT_EQ(refusal_of(needs, {{"--a", {true}}}), "");
    // A default is a value, too.
    EXPECT_EQ(refusal_of(needs, {{"--a", {true}}, {"--b", {true}}, {"--f", {false, "v"}}}), "");
    const OptionRule always{{}, {}, true, {{"--f", ""}}, "is so", ""};
    EXPECT_EQ(refusal_of(always, {}), "'degs x' is so, so it needs --f.");
}

} // namespace
} // namespace degs::sim_test
