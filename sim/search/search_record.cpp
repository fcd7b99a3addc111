// SPDX-License-Identifier: Apache-2.0
#include "sim/search/search_record.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "sim/results/result_words.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

/// What came out for a belief; nothing if the simulation failed.
const Candidate* found(const Search& search, const Belief& belief) {
    const std::vector<Candidate>& all = search.rungs.back().candidates;
    const auto same = std::find_if(all.begin(), all.end(), [&belief](const Candidate& candidate) {
        return candidate.variant == belief.variant;
    });
    return same == all.end() ? nullptr : &*same;
}

std::optional<double> found_goal(const Candidate* candidate, std::size_t goal) {
    return candidate == nullptr ? std::nullopt : candidate->verdict.goals.at(goal);
}

double all_cycles(const Search& search) {
    double cycles = 0;
    for (const Rung& rung : search.rungs) {
        cycles += rung.cycles;
    }
    return cycles;
}

std::size_t designs_of(const Search& search, bool estimates) {
    std::size_t most = 0; // a design of a later rung was in those before it
    for (const Rung& rung : search.rungs) {
        most = rung.change.estimates == estimates ? std::max(most, rung.candidates.size()) : most;
    }
    return most;
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
        if (errors.empty()) {
            continue;
        }
        std::sort(errors.begin(), errors.end());
        const double median = (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]) / 2;
        if (median > most) {
            most = median;
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
    spent["method"] = search.facts.method;
    for (const auto& [name, value] : search.facts.options) {
        spent[name] = value;
    }
    spent["estimated"] = designs_of(search, true);
    spent["simulated"] = plan.request.analytic ? 0 : designs_of(search, false);
    spent["simulated_cycles"] = all_cycles(search);
    if (!search.facts.end.empty()) {
        spent["end"] = search.facts.end;
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
    if (all_cycles(search) > 0) {
        text += grouped(static_cast<std::uint64_t>(all_cycles(search))) + " cycles simulated" +
                error_words(plan, search) + "\n";
    }
    if (!search.facts.end.empty()) {
        text += "the search ended because " + search.facts.end + "\n";
    }
    return text;
}

} // namespace degs::sim
