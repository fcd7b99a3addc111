// SPDX-License-Identifier: Apache-2.0
#include "sim/search/search_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/median.hpp"
#include "sim/results/result_words.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

/// What came out for a belief; nothing if the simulation failed.
const Candidate* found(const Search& search, const Belief& belief) {
    const std::vector<Candidate>& all = search.results.candidates;
    const auto same = std::find_if(all.begin(), all.end(), [&belief](const Candidate& candidate) {
        return candidate.variant == belief.variant;
    });
    return same == all.end() ? nullptr : &*same;
}

std::optional<double> found_goal(const Candidate* candidate, std::size_t goal) {
    return candidate == nullptr ? std::nullopt : candidate->verdict.goals.at(goal);
}

ordered_json belief_json(const StudyPlan& plan, const Search& search, const Belief& belief) {
    const Candidate* candidate = found(search, belief);
    ordered_json json = {{"name", plan.variants[belief.variant].name}, {"round", belief.round}};
    for (std::size_t g = 0; g < plan.aims.goals.size(); ++g) {
        const std::string& name = plan.aims.goals[g].name;
        json["believed"][name] = number_json(belief.goals[g]);
        json["found"][name] = number_json(found_goal(candidate, g));
    }
    json["on_front"] = candidate != nullptr && candidate->verdict.on_front;
    return json;
}

/// "; believed latency_ms was off by 2.1 % (median)" for the goal that was off most.
std::string error_words(const StudyPlan& plan, const Search& search) {
    double most = -1;
    std::size_t whose = 0;
    for (std::size_t g = 0; g < plan.aims.goals.size(); ++g) {
        std::vector<double> errors;
        for (const Belief& belief : search.beliefs) {
            const std::optional<double> goal = found_goal(found(search, belief), g);
            if (goal && belief.goals[g]) {
                errors.push_back(std::abs(*belief.goals[g] / *goal - 1));
            }
        }
        const std::optional<double> median = median_of(std::move(errors));
        if (median && *median > most) {
            most = *median;
            whose = g;
        }
    }
    constexpr double kPercent = 100;
    return most < 0 ? ""
                    : "; beliefs of " + plan.aims.goals[whose].name + " were off by " +
                          three_digits(kPercent * most) + " % (median)";
}

} // namespace

void put_record(const StudyPlan& plan, const Search& search, ordered_json& json) {
    ordered_json& spent = json["search"];
    for (const auto& [name, value] : search.options) {
        spent[name] = value;
    }
    const std::size_t designs = search.results.candidates.size();
    spent["estimated"] = search.estimates        ? search.estimates->candidates.size()
                         : plan.request.analytic ? designs
                                                 : 0;
    spent["simulated"] = plan.request.analytic ? 0 : designs;
    spent["simulated_cycles"] = search.results.cycles;
    if (!search.no_estimates.empty()) {
        spent["no_estimates"] = search.no_estimates;
    }
    if (!search.end.empty()) {
        spent["end"] = search.end;
    }
    for (const Belief& belief : search.beliefs) {
        json["beliefs"].push_back(belief_json(plan, search, belief));
    }
}

std::string beliefs_csv(const StudyPlan& plan, const Search& search) {
    std::string text = "round,design";
    for (const std::string& key : plan.keys) {
        text += "," + csv_cell(key);
    }
    for (const Aim& goal : plan.aims.goals) {
        text += "," + csv_cell("believed " + goal.name) + "," + csv_cell("found " + goal.name);
    }
    text += ",on_front\n";
    for (const Belief& belief : search.beliefs) {
        const StudyVariant& variant = plan.variants[belief.variant];
        const Candidate* candidate = found(search, belief);
        text += std::to_string(belief.round) + "," + csv_cell(variant.design);
        for (const std::string& value : variant.values) {
            text += "," + csv_cell(value);
        }
        for (std::size_t g = 0; g < plan.aims.goals.size(); ++g) {
            text += "," + csv_number(belief.goals[g]) + "," + csv_number(found_goal(candidate, g));
        }
        text += candidate != nullptr && candidate->verdict.on_front ? ",1\n" : ",0\n";
    }
    return text;
}

std::string record_text(const StudyPlan& plan, const Search& search) {
    std::string text;
    if (!search.no_estimates.empty()) {
        text += "no design was estimated, because " + search.no_estimates + "\n";
    }
    if (search.results.cycles > 0) {
        text += grouped(static_cast<std::uint64_t>(search.results.cycles)) + " cycles simulated" +
                error_words(plan, search) + "\n";
    }
    if (!search.end.empty()) {
        text += "the search ended because " + search.end + "\n";
    }
    return text;
}

} // namespace degs::sim
