// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/option_rules.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "config/config_words.hpp"
#include "sim/text/comma_parts.hpp"

namespace degs::sim {
namespace {

constexpr bool kNotWith = false, kNeeds = true;

/// A rule as it is written: lists of commands are separated by commas, lists of options by spaces.
/// "--fidelity=analytic" is an option with a value, "--frames!=1" one with another value, and
/// "config" an argument.
struct Row {
    const char* commands; ///< empty: all that have the options
    const char* options;  ///< empty: the command itself
    bool needs;
    const char* others;
    const char* reason;
    const char* beside = "";
};

constexpr const char* kSeveralViews =
    "gives a frame several views, and estimates are of frames with one view";

constexpr Row kRows[] = {
    // The view.
    {"run,workload export", "", kNeeds, "--scene --workload", "draws a view"},
    {"", "--workload", kNotWith,
     "--scene --camera-file --camera --width --height --resolution --crop --eyes --views "
     "--foveation",
     "has the scene and the view of its frame"},
    {"", "--resolution", kNotWith, "--width --height", "says both sides of the image"},
    {"scene info", "--width --resolution", kNeeds, "--camera", "is the size of a view"},
    // Paths, and frames of several views.
    {"", "--path-step", kNeeds, "--frames", "turns the camera from frame to frame"},
    {"", "--units-per-metre", kNeeds, "--poses --eyes", "is the scale of positions in metres"},
    {"motion", "--units-per-metre", kNeeds, "--eyes",
     "is of the eyes alone, as the poses are in scene units", "--in-scene"},
    {"motion", "--in-scene", kNeeds, "--poses", "is for recorded poses"},
    {"motion", "--between!=0", kNotWith, "--poses", "is for a path through cameras"},
    {"", "--views", kNotWith, "--eyes --camera --path-step",
     "names the cameras of all views of a frame"},
    {"run", "--maps", kNotWith, "--foveation", "shows the tiles of one view"},
    // Simulations, samples and estimates.
    {"run", "--within", kNotWith, "--fidelity=strict --fidelity=sampled",
     "says how many tiles are simulated"},
    {"run", "--frames!=1 --trace --block-log --memory-trace --maps", kNotWith,
     "--within --fidelity=sampled", "needs every tile"},
    {"compare,sweep,explore", "--frames!=1", kNotWith, "--within", "needs every tile"},
    {"run,compare,sweep,explore",
     "--frames!=1 --trace --block-log --memory-trace --maps --explain --array-only --within",
     kNotWith, "--fidelity=analytic", "needs a simulation"},
    {"motion", "--array-only", kNotWith, "--fidelity=analytic", "needs a simulation"},
    {"run", "--eyes --views --foveation", kNotWith,
     "--within --fidelity=sampled --fidelity=analytic --what-if", kSeveralViews},
    {"compare,sweep,explore,motion", "--eyes --views", kNotWith, "--within --fidelity=analytic",
     kSeveralViews},
    {"run", "--what-if", kNotWith, "--array-only", "estimates whole frames"},
    {"run,soc", "--trace-step", kNeeds, "--trace", "divides the timeline"},
    // Studies.
    {"sweep", "--shard", kNotWith, "--collect --list --sort --slurm", "runs a part of the points"},
    {"sweep", "--collect", kNotWith, "--list --slurm",
     "reads results that are in the folder already"},
    {"sweep", "--top", kNeeds, "--sort", "counts the designs of the table"},
    {"sweep", "--tasks --sbatch", kNeeds, "--slurm", "is for a job array"},
    {"explore", "--budget", kNotWith, "--fidelity=analytic", "counts simulations"},
    {"explore", "--patience", kNeeds, "--shard", "is a wait for the other parts"},
    // Platforms and memories.
    {"memory", "--trace", kNotWith,
     "--pattern --request-bytes --stride-bytes --reads-per-write --seed --requests --no-curve",
     "has requests of its own"},
    {"memory", "--trace-ghz", kNeeds, "--trace", "is the clock of a trace"},
    // Number formats.
    {"accuracy", "", kNeeds, "--scene --single-gaussian --hard-cases --speed",
     "measures what its options name"},
    {"accuracy", "--only", kNeeds, "--hard-cases", "names hard cases"},
    {"accuracy",
     "--camera --camera-file --width --height --crop --eyes --views --rules --order "
     "--antialiasing --projection --lens --low-pass --cut --near",
     kNotWith, "--hard-cases", "is of a view, and each hard case has its own"},
    {"accuracy", "--rules --order --antialiasing --projection --lens --low-pass --cut --near",
     kNotWith, "--speed", "is a rule, and configurations have rules of their own"},
    {"accuracy", "--eyes --views", kNotWith, "--speed", "gives a frame more than one view"},
    {"accuracy", "--fidelities --seeds --set --memory", kNeeds, "--speed",
     "is for runs of configurations"},
    // Scenes.
    {"scene tile", "", kNeeds, "--copies --gaussians", "shows a scene many times"},
    {"scene tile", "--gaussians", kNotWith, "--copies", "says how many copies there are"},
    {"scene generate,scene convert,scene tile", "", kNeeds, "out --out", "writes a file"},
    {"scene generate,scene convert,scene tile", "--out", kNotWith, "out", "names the file"},
    // Configurations.
    {"config", "--set --pes", kNeeds, "config", "changes a configuration"},
    {"config", "--diff", kNotWith, "config --pes --cost --stats", "names two configurations"},
    {"config", "--pes", kNotWith, "--stats", "writes a design"},
    {"config", "--stats", kNotWith, "--cost", "lists statistics"},
    {"config", "--of --section", kNeeds, "--stats", "is a part of the statistics"},
    {"config", "--of!=run", kNotWith, "config", "has the same statistics for every configuration"},
    {"config", "--keys", kNotWith, "--stats --cost --diff --pes",
     "lists keys of one configuration"},
    {"config", "--format=yaml", kNotWith, "--stats --diff", "writes one configuration"},
    {"config", "--format=yaml", kNotWith, "--cost",
     "writes one configuration, and costs come as text, markdown or json"},
    {"config", "--format=yaml", kNotWith,
     "--keys=shared --keys=similar --keys=own --keys=cost --keys=numbers", "writes all keys"},
    {"config", "--format=json", kNeeds, "--cost", "writes areas and powers"},
    {"config", "--schema", kNotWith,
     "config --set --pes --diff --format --cost --stats --of --section --keys",
     "is of a kind of file, whatever a file says"},
    // Help.
    {"help", "command", kNotWith, "--man --bash-completion --zsh-completion",
     "has a help of its own"},
    {"help", "--man", kNotWith, "--bash-completion --zsh-completion", "prints a page of its own"},
    {"help", "--bash-completion", kNotWith, "--zsh-completion", "prints a script of its own"},
};

OptionTerm term_of(const std::string& text) {
    const std::size_t at = text.find('=');
    if (at == std::string::npos) {
        return {text, ""};
    }
    const bool other = text[at - 1] == '!';
    return {text.substr(0, other ? at - 1 : at), text.substr(at + 1), other};
}

std::vector<OptionTerm> terms_of(const char* text) {
    std::istringstream words(text);
    std::vector<OptionTerm> terms;
    for (std::string word; words >> word;) {
        terms.push_back(term_of(word));
    }
    return terms;
}

OptionRule rule_of(const Row& row) {
    OptionRule rule;
    if (*row.commands != '\0') {
        rule.commands = comma_parts(row.commands);
    }
    rule.options = terms_of(row.options);
    rule.needs = row.needs;
    rule.others = terms_of(row.others);
    rule.reason = row.reason;
    rule.beside = row.beside;
    return rule;
}

template <class Has>
void keep_those_of(const Has& has, std::vector<OptionTerm>& terms) {
    terms.erase(std::remove_if(terms.begin(), terms.end(),
                               [&has](const OptionTerm& term) { return !has(term.option); }),
                terms.end());
}

std::string joined(const std::vector<OptionTerm>& terms) {
    std::vector<std::string> words;
    words.reserve(terms.size());
    for (const OptionTerm& term : terms) {
        words.push_back(words_of(term));
    }
    return config_words::list(words);
}

} // namespace

const std::vector<OptionRule>& option_rules() {
    static const std::vector<OptionRule> rules = [] {
        std::vector<OptionRule> all;
        for (const Row& row : kRows) {
            all.push_back(rule_of(row));
        }
        return all;
    }();
    return rules;
}

std::vector<OptionRule> rules_of(const std::string& command,
                                 const std::function<bool(const std::string& option)>& has) {
    std::vector<OptionRule> found;
    for (OptionRule rule : option_rules()) {
        const std::vector<std::string>& names = rule.commands;
        const bool own =
            names.empty() || std::find(names.begin(), names.end(), command) != names.end();
        const bool of_command = rule.options.empty();
        keep_those_of(has, rule.options);
        keep_those_of(has, rule.others);
        if (own && (of_command || !rule.options.empty()) && !rule.others.empty()) {
            found.push_back(std::move(rule));
        }
    }
    return found;
}

std::string words_of(const OptionTerm& term) {
    std::string words = term.option;
    if (words.front() != '-') {
        std::transform(words.begin(), words.end(), words.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    }
    return words + (term.value.empty() ? "" : (term.other ? " other than " : " ") + term.value);
}

std::string heading(const OptionRule& rule, const std::string& command) {
    return (rule.options.empty() ? command : joined(rule.options)) +
           (rule.beside.empty() ? "" : " beside " + rule.beside);
}

std::string explanation(const OptionRule& rule) {
    return (rule.needs ? rule.others.size() > 1 ? "needs one of " : "needs " : "not with ") +
           joined(rule.others) + "; " + (rule.options.size() > 1 ? "each " : "it ") + rule.reason;
}

std::vector<OptionConflict> conflicts_in(const std::vector<OptionRule>& rules) {
    std::vector<OptionConflict> conflicts;
    for (const OptionRule& rule : rules) {
        if (rule.needs) {
            continue;
        }
        for (const OptionTerm& option : rule.options) {
            for (const OptionTerm& other : rule.others) {
                conflicts.push_back({option, other});
                conflicts.push_back({other, option});
            }
        }
    }
    return conflicts;
}

} // namespace degs::sim
