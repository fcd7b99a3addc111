// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/ranking.hpp"

#include <algorithm>
#include <tuple>

#include "base/visible_text.hpp"
#include "sim/goals/judgement.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

struct Ranked {
    std::size_t variant = 0;
    bool breaks = false;
    Goals costs;
};

std::vector<Ranked> ranking(const std::vector<DesignVerdict>& verdicts,
                            const std::vector<Aim>& goals) {
    std::vector<Ranked> ranked;
    for (std::size_t v = 0; v < verdicts.size(); ++v) {
        if (verdicts[v].has_goals()) {
            ranked.push_back({v, !verdicts[v].is_within(), costs_of(goals_of(verdicts[v]), goals)});
        }
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
        return std::tie(a.breaks, a.costs) < std::tie(b.breaks, b.costs);
    });
    return ranked;
}

/// The cells of every goal, of designs that have all goals.
std::vector<std::vector<std::string>> goal_columns(const std::vector<DesignVerdict>& verdicts,
                                                   const std::vector<Ranked>& shown) {
    std::vector<std::vector<std::string>> columns;
    for (std::size_t g = 0; !shown.empty() && g < shown.front().costs.size(); ++g) {
        std::vector<double> values;
        values.reserve(shown.size());
        for (const Ranked& ranked : shown) {
            values.push_back(*verdicts[ranked.variant].goals[g]);
        }
        columns.push_back(told_apart(values));
    }
    return columns;
}

} // namespace

std::string ranking_text(const StudyPlan& plan, const SweepResults& results,
                         const std::vector<Aim>& goals, std::size_t most) {
    const std::size_t views = plan.points.size() / plan.variants.size();
    const bool limited = !plan.aims.limits.empty();
    const std::vector<DesignVerdict> verdicts =
        judge(results.comparison, views, {goals, plan.aims.limits});
    const std::vector<Ranked> ranked = ranking(verdicts, goals);
    std::vector<std::string> head{"best"};
    for (const Aim& goal : goals) {
        head.push_back(goal.name);
    }
    if (limited) {
        head.emplace_back("within");
    }
    TextTable table(head);
    std::vector<Ranked> shown(ranked.begin(), ranked.begin() + std::min(most, ranked.size()));
    const std::vector<std::vector<std::string>> columns = goal_columns(verdicts, shown);
    for (std::size_t r = 0; r < shown.size(); ++r) {
        const std::size_t variant = shown[r].variant;
        std::vector<std::string> cells{visible(plan.variants[variant].name)};
        for (const std::vector<std::string>& column : columns) {
            cells.push_back(column[r]);
        }
        if (limited) {
            cells.push_back(within_words(verdicts[variant]));
        }
        table.add(cells);
    }
    std::string text = "\n" + table.text();
    if (ranked.size() > most) {
        text += "... and " + grouped(ranked.size() - most) + " more designs\n";
    }
    if (ranked.size() < plan.variants.size()) {
        text += grouped(plan.variants.size() - ranked.size()) +
                " designs lack a view or a number that they are sorted by\n";
    }
    return text + "\n";
}

} // namespace degs::sim
