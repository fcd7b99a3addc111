// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/search_output.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/report/report.hpp"
#include "sim/results/result_words.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

std::vector<Goals> costs_in(const Rung& rung, const SearchOptions& options) {
    std::vector<Goals> costs;
    for (const Candidate& candidate : rung.candidates) {
        costs.push_back(costs_of(candidate.goals, options));
    }
    return costs;
}

/// The last rung in the order of the first goal, the best first.
std::vector<FrontPoint> points_of(const StudyPlan& plan, const Rung& rung,
                                  const SearchOptions& options,
                                  std::vector<std::size_t>& variants) {
    const std::vector<Goals> costs = costs_in(rung, options);
    const std::vector<std::size_t> front = pareto_front(costs);
    std::vector<std::size_t> order(rung.candidates.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::sort(order.begin(), order.end(), [&costs](std::size_t a, std::size_t b) {
        return std::make_pair(costs[a], a) < std::make_pair(costs[b], b);
    });
    std::vector<FrontPoint> points;
    for (const std::size_t position : order) {
        const Candidate& candidate = rung.candidates[position];
        variants.push_back(candidate.variant);
        points.push_back({candidate.goals[0], candidate.goals[1],
                          std::find(front.begin(), front.end(), position) != front.end(),
                          candidate.variant == plan.baseline});
    }
    return points;
}

std::string fidelity_of(const CompareRequest& request) {
    return request.analytic ? "analytic" : request.sampling ? "sampled" : "exact";
}

std::string front_csv(const StudyPlan& plan, const SearchOptions& options,
                      const std::vector<FrontPoint>& points,
                      const std::vector<std::size_t>& variants) {
    std::string text = "design";
    for (const std::string& key : plan.keys) {
        text += "," + csv_cell(key);
    }
    for (const Measure goal : options.goals) {
        text += "," + name_of(goal);
    }
    text += ",on_front,baseline,fidelity\n";
    for (std::size_t p = 0; p < points.size(); ++p) {
        const StudyVariant& variant = plan.variants[variants[p]];
        text += csv_cell(variant.design);
        for (const std::string& value : variant.values) {
            text += "," + csv_cell(value);
        }
        text += "," + csv_number(points[p].x) + "," + csv_number(points[p].y) + "," +
                (points[p].on_front ? "1" : "0") + "," + (points[p].baseline ? "1" : "0") + "," +
                fidelity_of(plan.request) + "\n";
    }
    return text;
}

/// How well a rung ranks those designs that went on, in one goal.
std::optional<double> agreement(const Rung& rung, const Rung& next, std::size_t goal) {
    std::vector<double> before;
    std::vector<double> after;
    for (const Candidate& candidate : next.candidates) {
        const auto same = std::find_if(
            rung.candidates.begin(), rung.candidates.end(),
            [&candidate](const Candidate& other) { return other.variant == candidate.variant; });
        if (same != rung.candidates.end()) {
            before.push_back(same->goals.at(goal));
            after.push_back(candidate.goals.at(goal));
        }
    }
    return rank_correlation(before, after);
}

ordered_json rung_json(const StudyPlan& plan, const Search& search, std::size_t r,
                       const SearchOptions& options) {
    const Rung& rung = search.rungs[r];
    ordered_json json = {{"divisor", rung.divisor}, {"designs", ordered_json::array()}};
    for (const Candidate& candidate : rung.candidates) {
        ordered_json row = {{"name", plan.variants[candidate.variant].name}};
        for (std::size_t g = 0; g < options.goals.size(); ++g) {
            row[name_of(options.goals.at(g))] = candidate.goals.at(g);
        }
        json["designs"].push_back(std::move(row));
    }
    json["failed"] = ordered_json::array();
    for (const FailedRun& failed : rung.failed) {
        json["failed"].push_back({{"name", failed.config}, {"why", failed.sentence}});
    }
    if (r + 1 < search.rungs.size()) {
        for (std::size_t g = 0; g < options.goals.size(); ++g) {
            json["rank_correlation_with_next"][name_of(options.goals.at(g))] =
                number_json(agreement(rung, search.rungs[r + 1], g));
        }
    }
    return json;
}

ordered_json search_json(const StudyPlan& plan, const Search& search,
                         const SearchOptions& options) {
    ordered_json json;
    json["schema"] = {{"name", "degs-explore"}, {"version", kExploreVersion}};
    json["tool"] = tool_json();
    json["study"] = plan.name;
    json["fidelity"] = fidelity_of(plan.request);
    json["goals"] = {name_of(options.goals[0]), name_of(options.goals[1])};
    json["better"] = ordered_json::array();
    for (const Measure goal : options.goals) {
        json["better"].push_back(direction_of(goal) == Direction::Maximise ? "larger" : "smaller");
    }
    json["skipped"] = ordered_json::array();
    for (const SkippedVariant& skipped : plan.skipped) {
        json["skipped"].push_back({{"name", skipped.variant.name}, {"why", skipped.why}});
    }
    json["rungs"] = ordered_json::array();
    for (std::size_t r = 0; r < search.rungs.size(); ++r) {
        json["rungs"].push_back(rung_json(plan, search, r, options));
    }
    return json;
}

/// "fps (larger is better)".
std::string goal_words(Measure goal) {
    return name_of(goal) + " (" + direction_words(direction_of(goal)) + ")";
}

/// The values of a design that are not those of its file: "span.count=4 packing.bytes=8192".
std::string changes_of(const StudyVariant& variant) {
    const std::string name = variant.name;
    return name == variant.design ? name : name.substr(variant.design.size() + 1);
}

} // namespace

void write_search(const StudyPlan& plan, const Search& search, const SearchOptions& options,
                  const OutputFolder& folder) {
    std::vector<std::size_t> variants;
    const std::vector<FrontPoint> points = points_of(plan, search.rungs.back(), options, variants);
    folder.replace([&] {
        folder.write_text("front.csv", front_csv(plan, options, points, variants));
        folder.write_text("front.svg",
                          front_svg(plan.name + (plan.request.analytic ? " (estimates)" : ""),
                                    goal_words(options.goals[0]), goal_words(options.goals[1]),
                                    points));
        folder.write_json("explore.json", search_json(plan, search, options));
    });
}

std::string search_text(const StudyPlan& plan, const Search& search, const SearchOptions& options) {
    std::string text;
    for (std::size_t r = 0; r < search.rungs.size(); ++r) {
        const Rung& rung = search.rungs[r];
        text += std::to_string(rung.candidates.size()) + " designs " +
                (rung.divisor == 1 ? "at full size"
                                   : "at 1/" + std::to_string(rung.divisor) + " of the size");
        if (r + 1 < search.rungs.size()) {
            const auto agreed = agreement(rung, search.rungs[r + 1], 1);
            text += agreed ? "; rank correlation with the next line " + three_digits(*agreed) : "";
        }
        text += "\n";
    }
    if (!plan.skipped.empty()) {
        text += grouped(plan.skipped.size()) + " designs cannot be built\n";
    }
    std::vector<std::size_t> variants;
    const std::vector<FrontPoint> points = points_of(plan, search.rungs.back(), options, variants);
    TextTable table({"front", name_of(options.goals[0]), name_of(options.goals[1])});
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (points[p].on_front || points[p].baseline) {
            table.add({visible(changes_of(plan.variants[variants[p]])) +
                           (points[p].on_front ? "" : " (baseline, beaten)"),
                       three_digits(points[p].x), three_digits(points[p].y)});
        }
    }
    text += plan.request.analytic ? "estimates of the analytic model, not simulations: " : "";
    return text + goal_words(options.goals[0]) + "; " + goal_words(options.goals[1]) + "\n\n" +
           table.text();
}

} // namespace degs::sim
