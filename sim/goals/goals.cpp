// SPDX-License-Identifier: Apache-2.0
#include "sim/goals/goals.hpp"

#include <algorithm>
#include <cctype>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/text/comma_parts.hpp"

namespace degs::sim {
namespace {

using config_words::quote;

std::string without_blanks(const std::string& text) {
    std::string rest;
    std::copy_if(text.begin(), text.end(), std::back_inserter(rest),
                 [](char c) { return std::isspace(static_cast<unsigned char>(c)) == 0; });
    return rest;
}

bool take_start(std::string& text, const std::string& start) {
    const bool found = text.rfind(start, 0) == 0;
    text.erase(0, found ? start.size() : 0);
    return found;
}

/// Whether the parenthesis that the text begins behind closes at its end: "a)" but not "a)*(b)".
bool closes_at_end(const std::string& text) {
    int depth = 1;
    for (std::size_t at = 0; at < text.size(); ++at) {
        depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
        if (depth == 0) {
            return at + 1 == text.size();
        }
    }
    return false;
}

/// "worst(latency_ms)"; the direction is that of the measures.
Aim aim_of(const std::string& text, const std::string& place) {
    Aim aim;
    aim.name = text;
    std::string inner = text;
    for (const auto& [word, fold] :
         {std::pair("worst(", Fold::Worst), std::pair("mean(", Fold::Mean)}) {
        std::string rest = text;
        if (take_start(rest, word) && closes_at_end(rest)) {
            inner = rest.substr(0, rest.size() - 1);
            aim.fold = fold;
        }
    }
    aim.expression = Expression::parse(inner, place);
    aim.better = aim.expression.direction();
    if (aim.expression.has(Expression::Kind::Baseline)) {
        throw InputError(place + " says " + quote(text) +
                         ", but 'baseline' stands for a value on the right side of a limit only.");
    }
    for (const ExpressionStep& step : aim.expression.steps()) {
        if (step.kind == Expression::Kind::Measure && is_of_host(step.measure)) {
            throw InputError(place + " names '" + name_of(step.measure) +
                             "', of which neither small nor large values are better; allowed are " +
                             config_words::list(allowed_goals([](Measure) { return true; })) + ".");
        }
    }
    return aim;
}

[[noreturn]] void fail_direction(const Aim& goal, const std::string& place) {
    if (goal.expression.steps().size() == 1) {
        throw InputError(place + " names " + quote(goal.name) +
                         ", of which neither small nor large values are better; allowed are " +
                         config_words::list(allowed_goals([](Measure) { return true; })) +
                         ", and any measure behind 'min:' or 'max:'.");
    }
    throw InputError(place + " says " + quote(goal.name) +
                     ", of which the measures do not tell whether small or large values are "
                     "better; write 'min:' or 'max:' in front.");
}

Limit limit_of(const std::string& text, const std::string& place) {
    const std::size_t at = text.find_first_of("<>");
    if (at == std::string::npos || at == 0) {
        throw InputError(place + " says " + quote(text) +
                         ", but a limit is written as area_mm2<=2.5, with <=, <, >= or >.");
    }
    Limit limit;
    limit.name = text;
    limit.at_most = text[at] == '<';
    limit.or_equal = text.compare(at + 1, 1, "=") == 0;
    limit.aim = aim_of(text.substr(0, at), place);
    limit.aim.better = limit.at_most ? Direction::Minimise : Direction::Maximise;
    limit.bound = Expression::parse(text.substr(at + (limit.or_equal ? 2 : 1)), place);
    if (limit.bound.has(Expression::Kind::Measure)) {
        throw InputError(place + " says " + quote(text) +
                         ", but only numbers and 'baseline' stand on the right side; measures "
                         "stand on the left, as in latency_ms/area_mm2<=2.");
    }
    return limit;
}

} // namespace

std::vector<Aim> parse_goals(const std::string& text, const std::string& place) {
    std::vector<Aim> goals;
    for (const std::string& part : comma_parts(text)) {
        std::string words = without_blanks(part);
        const bool most = take_start(words, "max:");
        const bool least = !most && take_start(words, "min:");
        Aim goal = aim_of(words, place);
        goal.better = most ? Direction::Maximise : least ? Direction::Minimise : goal.better;
        if (goal.better == Direction::None) {
            fail_direction(goal, place);
        }
        if (std::any_of(goals.begin(), goals.end(),
                        [&goal](const Aim& other) { return other.name == goal.name; })) {
            throw InputError(place + " names " + quote(goal.name) +
                             " twice, but a search needs different goals.");
        }
        goals.push_back(std::move(goal));
    }
    if (goals.size() > kMostGoals) {
        throw InputError(place + " has " + std::to_string(goals.size()) + " goals, but at most " +
                         std::to_string(kMostGoals) + " are allowed.");
    }
    return goals;
}

std::vector<Limit> parse_limits(const std::string& text, const std::string& place) {
    std::vector<Limit> limits;
    for (const std::string& part : comma_parts(text)) {
        // The name of a design may have blanks, which the others only separate words with.
        const std::size_t named = std::min(part.find("baseline("), part.size());
        limits.push_back(
            limit_of(without_blanks(part.substr(0, named)) + part.substr(named), place));
    }
    return limits;
}

std::vector<Measure> measures_in(const Aims& aims) {
    std::vector<Measure> measures;
    const auto add = [&measures](const Aim& aim) {
        for (const ExpressionStep& step : aim.expression.steps()) {
            if (step.kind == Expression::Kind::Measure &&
                std::find(measures.begin(), measures.end(), step.measure) == measures.end()) {
                measures.push_back(step.measure);
            }
        }
    };
    std::for_each(aims.goals.begin(), aims.goals.end(), add);
    for (const Limit& limit : aims.limits) {
        add(limit.aim);
    }
    return measures;
}

std::vector<std::string> designs_in(const Aims& aims) {
    std::vector<std::string> designs;
    for (const Limit& limit : aims.limits) {
        for (const ExpressionStep& step : limit.bound.steps()) {
            if (!step.design.empty() &&
                std::find(designs.begin(), designs.end(), step.design) == designs.end()) {
                designs.push_back(step.design);
            }
        }
    }
    return designs;
}

std::vector<std::string> allowed_goals(const std::function<bool(Measure)>& has) {
    std::vector<std::string> allowed;
    for_each_measure([&](Measure measure) {
        if (direction_of(measure) != Direction::None && has(measure)) {
            allowed.push_back(name_of(measure));
        }
    });
    return allowed;
}

std::string goal_words(const Aim& goal) {
    return goal.name + " (" + direction_words(goal.better) + ")";
}

} // namespace degs::sim
