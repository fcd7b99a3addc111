// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/combinations.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "degs/error.hpp"

namespace degs::sim {
namespace {

std::optional<double> number_in(const std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end ? std::optional(value) : std::nullopt;
}

/// "sampled:10%" is sampled, and 01 is 1.
bool is_value(const std::string& text, const std::string& value) {
    const std::optional<double> number = number_in(value);
    return text == value || text.rfind(value + ":", 0) == 0 ||
           (number && number_in(text) == number);
}

bool holds(const OptionTerm& term, const OptionState& state) {
    if (term.value.empty()) {
        return state.given;
    }
    return term.other ? state.given && !is_value(state.value, term.value)
                      : is_value(state.value, term.value);
}

/// The first of the terms that holds, or none.
const OptionTerm* first_of(const std::vector<OptionTerm>& terms, const OptionStates& states) {
    const auto found = std::find_if(terms.begin(), terms.end(), [&states](const OptionTerm& term) {
        return holds(term, states(term.option));
    });
    return found == terms.end() ? nullptr : &*found;
}

/// "--fidelity analytic (or 'fidelity' of a study)"; a value that is not another one is as given.
std::string name_of(const OptionTerm& term, const OptionStates& states) {
    const std::string origin = states(term.option).origin;
    return (term.other ? words_of({term.option, ""}) : words_of(term)) +
           (origin.empty() ? "" : " (" + origin + ")");
}

std::string alternatives(const std::vector<OptionTerm>& terms) {
    std::string words;
    for (const OptionTerm& term : terms) {
        const char* const between = words.empty() ? "" : &term == &terms.back() ? " or " : ", ";
        words += between + words_of(term);
    }
    return words;
}

/// What breaks the rule: "--trace-step divides the timeline, so it needs --trace."; empty: nothing.
std::string breach(const OptionRule& rule, const std::string& command, const OptionStates& states) {
    if (!rule.beside.empty() && !states(rule.beside).given) {
        return "";
    }
    const OptionTerm* const option = first_of(rule.options, states);
    const OptionTerm* const other = first_of(rule.others, states);
    if ((!rule.options.empty() && option == nullptr) || (other != nullptr) == rule.needs) {
        return "";
    }
    std::string subject = option == nullptr ? "'" + command + "'" : name_of(*option, states);
    subject += rule.beside.empty() ? "" : " beside " + rule.beside;
    return subject + " " + rule.reason + ", so it " +
           (rule.needs ? "needs " + alternatives(rule.others)
                       : "cannot be combined with " + name_of(*other, states)) +
           ".";
}

} // namespace

void refuse_combinations(const std::string& command, const std::vector<OptionRule>& rules,
                         const OptionStates& states) {
    for (const OptionRule& rule : rules) {
        if (const std::string sentence = breach(rule, command, states); !sentence.empty()) {
            throw InputError(sentence);
        }
    }
}

} // namespace degs::sim
