// SPDX-License-Identifier: Apache-2.0
#include "sim/search/search_output.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/report/report.hpp"
#include "sim/results/result_words.hpp"
#include "sim/search/rank_correlation.hpp"
#include "sim/search/search_record.hpp"
#include "sim/text/output_columns.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

/// The results in the order of the first goal, the best first.
std::vector<Candidate> ordered(const StudyPlan& plan, const Search& search) {
    std::vector<Candidate> candidates = search.results.candidates;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&plan](const Candidate& a, const Candidate& b) {
                         return costs_of(goals_of(a.verdict), plan.aims.goals) <
                                costs_of(goals_of(b.verdict), plan.aims.goals);
                     });
    return candidates;
}

/// How the results were found.
std::string fidelity_of(const CompareRequest& request) {
    return request.analytic ? "analytic" : request.sampling ? "sampled" : "exact";
}

/// What a limit is about, where no goal and no earlier limit shows it: it is beside the goals.
std::vector<std::size_t> limits_beside_goals(const Aims& aims) {
    std::set<std::string> shown;
    for (const Aim& goal : aims.goals) {
        shown.insert(goal.name);
    }
    std::vector<std::size_t> limits;
    for (std::size_t l = 0; l < aims.limits.size(); ++l) {
        if (shown.insert(aims.limits[l].aim.name).second) {
            limits.push_back(l);
        }
    }
    return limits;
}

std::optional<double> limited_value(const Candidate& candidate, std::size_t limit) {
    const std::vector<LimitValue>& limits = candidate.verdict.limits;
    return limits.empty() ? std::nullopt : limits[limit].value;
}

std::string front_csv(const StudyPlan& plan, const std::vector<Candidate>& candidates) {
    const std::string fidelity = fidelity_of(plan.request);
    const bool limited = !plan.aims.limits.empty();
    std::string text = "design";
    for (const std::string& key : plan.keys) {
        text += "," + csv_cell(key);
    }
    for (const Aim& goal : plan.aims.goals) {
        text += "," + csv_cell(goal.name);
    }
    const std::vector<std::size_t> beside = limits_beside_goals(plan.aims);
    for (const std::size_t limit : beside) {
        text += "," + csv_cell(plan.aims.limits[limit].aim.name);
    }
    text += std::string(",on_front,baseline,fidelity") + (limited ? ",within" : "") + "\n";
    for (const Candidate& candidate : candidates) {
        const StudyVariant& variant = plan.variants[candidate.variant];
        text += csv_cell(variant.design);
        for (const std::string& value : variant.values) {
            text += "," + csv_cell(value);
        }
        for (const std::optional<double>& goal : candidate.verdict.goals) {
            text += "," + csv_number(goal);
        }
        for (const std::size_t limit : beside) {
            text += "," + csv_number(limited_value(candidate, limit));
        }
        text += std::string(candidate.verdict.on_front ? ",1" : ",0") +
                (candidate.variant == plan.baseline ? ",1," : ",0,") + fidelity +
                (limited ? "," + csv_cell(within_words(candidate.verdict)) : "") + "\n";
    }
    return text;
}

/// How well estimates rank the designs of the results, in one goal.
std::optional<double> agreement(const Search& search, std::size_t goal) {
    std::vector<double> before;
    std::vector<double> after;
    const std::vector<Candidate>& estimated = search.estimates->candidates;
    for (const Candidate& candidate : search.results.candidates) {
        const auto same =
            std::find_if(estimated.begin(), estimated.end(), [&candidate](const Candidate& other) {
                return other.variant == candidate.variant;
            });
        if (same != estimated.end() && same->verdict.goals.at(goal)) {
            before.push_back(*same->verdict.goals.at(goal));
            after.push_back(*candidate.verdict.goals.at(goal));
        }
    }
    return rank_correlation(before, after);
}

ordered_json step_json(const StudyPlan& plan, const StepResults& results) {
    const std::vector<Aim>& goals = plan.aims.goals;
    ordered_json json = {{"designs", ordered_json::array()}, {"failed", ordered_json::array()}};
    for (const Candidate& candidate : results.candidates) {
        ordered_json row = {{"name", plan.variants[candidate.variant].name}};
        for (std::size_t g = 0; g < goals.size(); ++g) {
            row[goals[g].name] = number_json(candidate.verdict.goals[g]);
        }
        if (!plan.aims.limits.empty()) {
            row["within"] = within_words(candidate.verdict);
        }
        json["designs"].push_back(std::move(row));
    }
    for (const FailedRun& failed : results.failed) {
        json["failed"].push_back({{"name", failed.config}, {"why", failed.sentence}});
    }
    return json;
}

ordered_json search_json(const StudyPlan& plan, const Search& search) {
    ordered_json json;
    json["schema"] = {{"name", "degs-explore"}, {"version", kExploreVersion}};
    json["tool"] = tool_json();
    json["study"] = plan.name;
    json["fidelity"] = fidelity_of(plan.request);
    put_record(plan, search, json);
    json["goals"] = ordered_json::array();
    json["better"] = ordered_json::array();
    for (const Aim& goal : plan.aims.goals) {
        json["goals"].push_back(goal.name);
        json["better"].push_back(goal.better == Direction::Maximise ? "larger" : "smaller");
    }
    for (const Limit& limit : plan.aims.limits) {
        json["limits"].push_back(limit.name);
    }
    json["skipped"] = ordered_json::array();
    for (const SkippedVariant& skipped : plan.skipped) {
        json["skipped"].push_back({{"name", skipped.variant.name}, {"why", skipped.why}});
    }
    if (search.estimates) {
        json["estimates"] = step_json(plan, *search.estimates);
        for (std::size_t g = 0; g < plan.aims.goals.size(); ++g) {
            json["estimates"]["rank_correlation"][plan.aims.goals[g].name] =
                number_json(agreement(search, g));
        }
    }
    json["results"] = step_json(plan, search.results);
    return json;
}

/// The values of a design that are not those of its file: "span.count=4 packing.bytes=8192".
std::string changes_of(const StudyVariant& variant) {
    const std::string name = variant.name;
    return name == variant.design ? name : name.substr(variant.design.size() + 1);
}

/// What a line of the front says beside the design's values.
std::string remark_on(const Candidate& candidate, bool baseline) {
    if (candidate.verdict.on_front) {
        return "";
    }
    const std::string why =
        candidate.verdict.is_within() ? "beaten" : "breaks " + within_words(candidate.verdict);
    return baseline ? " (baseline, " + why + ")" : " (" + why + ")";
}

/// The cells of every goal, and of what else limits are about.
std::vector<std::vector<std::string>> front_columns(const Aims& aims,
                                                    const std::vector<Candidate>& shown) {
    std::vector<std::vector<std::string>> columns;
    std::vector<double> values;
    for (std::size_t g = 0; g < aims.goals.size(); ++g) {
        values.clear();
        for (const Candidate& candidate : shown) {
            values.push_back(goals_of(candidate.verdict)[g]);
        }
        columns.push_back(told_apart(values));
    }
    for (const std::size_t limit : limits_beside_goals(aims)) {
        values.clear();
        for (const Candidate& candidate : shown) {
            values.push_back(limited_value(candidate, limit).value_or(NAN));
        }
        columns.push_back(told_apart(values));
    }
    return columns;
}

/// The front and the baseline; where nothing is within the limits, the design that misses them
/// least.
std::string front_table(const StudyPlan& plan, const std::vector<Candidate>& candidates) {
    std::vector<std::string> head{"front"};
    for (const Aim& goal : plan.aims.goals) {
        head.push_back(goal.name);
    }
    for (const std::size_t limit : limits_beside_goals(plan.aims)) {
        head.push_back(visible(plan.aims.limits[limit].aim.name));
    }
    TextTable table(head);
    const auto nearest = std::min_element(
        candidates.begin(), candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.verdict.excess < b.verdict.excess; });
    const bool none = nearest != candidates.end() && !nearest->verdict.is_within();
    std::vector<Candidate> shown;
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(shown),
                 [&](const Candidate& candidate) {
                     return candidate.verdict.on_front || candidate.variant == plan.baseline ||
                            (none && candidate.variant == nearest->variant);
                 });
    const std::vector<std::vector<std::string>> columns = front_columns(plan.aims, shown);
    for (std::size_t row = 0; row < shown.size(); ++row) {
        const Candidate& candidate = shown[row];
        std::vector<std::string> cells{visible(changes_of(plan.variants[candidate.variant])) +
                                       remark_on(candidate, candidate.variant == plan.baseline)};
        for (const std::vector<std::string>& column : columns) {
            cells.push_back(column[row]);
        }
        table.add(cells);
    }
    return (none ? "no design is within the limits; the nearest is shown\n\n" : "\n") +
           table.text();
}

/// "; rank correlation with the simulations 0.99": of the second goal of two, else the least of
/// all.
std::string agreement_words(const StudyPlan& plan, const Search& search) {
    const std::size_t goals = plan.aims.goals.size();
    std::optional<double> least;
    std::size_t whose = 0;
    for (std::size_t g = goals == 2 ? 1 : 0; g < goals; ++g) {
        const std::optional<double> agreed = agreement(search, g);
        if (agreed && (!least || *agreed < *least)) {
            least = agreed;
            whose = g;
        }
    }
    if (!least) {
        return "";
    }
    return "; " + std::string(goals > 2 ? "least " : "") +
           "rank correlation with the simulations " + three_digits(*least) +
           (goals > 2 ? " (" + plan.aims.goals[whose].name + ")" : "");
}

/// How many designs were estimated, and how many simulated.
std::string counts_text(const StudyPlan& plan, const Search& search) {
    std::string text;
    if (search.estimates) {
        text += grouped(search.estimates->candidates.size()) + " designs estimated" +
                agreement_words(plan, search) + "\n";
    }
    return text + grouped(search.results.candidates.size()) + " designs " +
           (plan.request.analytic ? "estimated" : "simulated") + "\n";
}

std::string limits_text(const StudyPlan& plan, const std::vector<Candidate>& candidates) {
    const auto within =
        std::count_if(candidates.begin(), candidates.end(),
                      [](const Candidate& candidate) { return candidate.verdict.is_within(); });
    std::string text = "limits: ";
    for (const Limit& limit : plan.aims.limits) {
        text += (&limit == &plan.aims.limits.front() ? "" : ", ") + limit.name;
    }
    return visible(text) + "; " + grouped(static_cast<std::size_t>(within)) + " of " +
           grouped(candidates.size()) + " designs are within them\n";
}

/// One goal over the places of the designs, two against each other, or a chart for each pair.
std::string picture(const StudyPlan& plan, const std::vector<Candidate>& candidates) {
    const std::string title = plan.name + (plan.request.analytic ? " (estimates)" : "");
    std::vector<std::string> labels;
    for (const Aim& goal : plan.aims.goals) {
        labels.push_back(goal_words(goal));
    }
    std::vector<FrontPoint> points;
    std::vector<ManyGoals> designs;
    for (const Candidate& candidate : candidates) {
        const FrontMark mark{candidate.verdict.on_front, candidate.variant == plan.baseline,
                             candidate.verdict.is_within()};
        const double place = static_cast<double>(points.size() + 1);
        const Goals goals = goals_of(candidate.verdict);
        points.push_back({labels.size() == 1 ? place : goals[0], goals.back(), mark});
        designs.push_back({goals, mark});
    }
    return labels.size() > 2 ? front_pairs_svg(title, labels, designs)
           : labels.size() == 2
               ? front_svg(title, labels[0], labels[1], points)
               : front_svg(title, "place of the design", labels[0], points, "the best");
}

} // namespace

void write_search(const StudyPlan& plan, const Search& search, const OutputFolder& folder) {
    const std::vector<Candidate> candidates = ordered(plan, search);
    folder.replace([&] {
        folder.write_text("front.csv", front_csv(plan, candidates));
        folder.write_text("front.svg", picture(plan, candidates));
        folder.write_json("explore.json", search_json(plan, search));
        if (!search.beliefs.empty()) {
            folder.write_text("beliefs.csv", beliefs_csv(plan, search));
        }
    });
}

std::string search_text(const StudyPlan& plan, const Search& search) {
    std::string text = counts_text(plan, search);
    text += record_text(plan, search);
    if (!plan.skipped.empty()) {
        text += grouped(plan.skipped.size()) + " designs cannot be built\n";
    }
    const std::vector<Candidate> candidates = ordered(plan, search);
    text += plan.aims.limits.empty() ? "" : limits_text(plan, candidates);
    text += plan.request.analytic ? "estimates of the analytic model, not simulations: " : "";
    for (const Aim& goal : plan.aims.goals) {
        text += (&goal == &plan.aims.goals.front() ? "" : "; ") + goal_words(goal);
    }
    return folded(text, output_columns(), 2) + "\n" + front_table(plan, candidates);
}

} // namespace degs::sim
