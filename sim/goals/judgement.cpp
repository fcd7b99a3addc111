// SPDX-License-Identifier: Apache-2.0
#include "sim/goals/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace degs::sim {
namespace {

using Rows = std::vector<const ComparisonRow*>; // of one design, a view each

/// Equal values, such as areas, come out as they are. The mean of what is 0 once is 0, and there is
/// none of negative values.
std::optional<double> geometric_mean(const std::vector<double>& values) {
    const double first = values.front();
    double logs = 0; // of the ratios to the first
    for (const double value : values) {
        if (value < 0 || std::isinf(value)) {
            return value < 0 ? std::nullopt : std::optional<double>(value);
        }
        logs += first > 0 && value > 0 ? std::log(value / first) : 0;
    }
    const bool has_zero = std::find(values.begin(), values.end(), 0.0) != values.end();
    return has_zero ? 0 : first * std::exp(logs / static_cast<double>(values.size()));
}

std::optional<double> value_of(const Aim& aim, const Rows& rows) {
    std::vector<double> values;
    for (const ComparisonRow* row : rows) {
        const std::optional<double> value = aim.expression.value(row->measures);
        if (!value) {
            return {};
        }
        values.push_back(*value);
    }
    if (aim.fold == Fold::Mean) {
        return values.size() == 1 ? values.front() : geometric_mean(values);
    }
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return aim.better == Direction::Maximise ? *least : *most;
}

/// The rows of every configuration; without any where a view is missing.
std::vector<Rows> rows_by_config(const Comparison& comparison, std::size_t views) {
    std::vector<Rows> rows(comparison.configs.size());
    for (const ComparisonRow& row : comparison.rows) {
        rows[row.config].push_back(&row);
    }
    for (Rows& own : rows) {
        if (own.size() < views) {
            own.clear();
        }
    }
    return rows;
}

std::optional<double> bound_of(const Limit& limit, const Comparison& comparison,
                               const std::vector<Rows>& rows) {
    return limit.bound.value([&](const ExpressionStep& step) -> std::optional<double> {
        std::size_t config = comparison.baseline;
        if (!step.design.empty()) {
            const auto found = std::find_if(
                comparison.configs.begin(), comparison.configs.end(),
                [&step](const ComparedConfig& each) { return each.name == step.design; });
            config = static_cast<std::size_t>(found - comparison.configs.begin());
        }
        if (config >= rows.size() || rows[config].empty()) {
            return {};
        }
        return value_of(limit.aim, rows[config]);
    });
}

void check_limits(const std::vector<Limit>& limits,
                  const std::vector<std::optional<double>>& bounds, const Rows& rows,
                  DesignVerdict& verdict) {
    verdict.judged = true;
    for (std::size_t l = 0; l < limits.size(); ++l) {
        const std::optional<double> value = value_of(limits[l].aim, rows);
        verdict.limits.push_back({value, bounds[l]});
        if (!value || !bounds[l]) {
            verdict.judged = false;
        } else if (!holds(limits[l], *value, *bounds[l])) {
            verdict.broken.push_back(limits[l].name);
            verdict.excess += excess_of(*value, *bounds[l]);
        }
    }
}

/// Marks the front of those that have all goals and are within all limits, with all that are equal
/// to one of it, because nobody beats them either.
void mark_front(const std::vector<Aim>& wanted, std::vector<DesignVerdict>& verdicts) {
    std::vector<Goals> costs;
    std::vector<std::size_t> configs;
    for (std::size_t c = 0; c < verdicts.size(); ++c) {
        if (verdicts[c].is_within() && verdicts[c].has_goals()) {
            costs.push_back(costs_of(goals_of(verdicts[c]), wanted));
            configs.push_back(c);
        }
    }
    std::set<Goals> front;
    for (const std::size_t position : pareto_front(costs)) {
        front.insert(costs[position]);
    }
    for (std::size_t position = 0; position < costs.size(); ++position) {
        verdicts[configs[position]].on_front = front.count(costs[position]) != 0;
    }
}

} // namespace

bool DesignVerdict::has_goals() const {
    return !goals.empty() &&
           std::all_of(goals.begin(), goals.end(),
                       [](const std::optional<double>& goal) { return goal.has_value(); });
}

bool holds(const Limit& limit, double value, double bound) {
    return limit.at_most ? (limit.or_equal ? value <= bound : value < bound)
                         : (limit.or_equal ? value >= bound : value > bound);
}

double excess_of(double value, double bound) {
    return std::abs(value - bound) / std::max(std::abs(bound), std::numeric_limits<double>::min());
}

std::vector<DesignVerdict> judge(const Comparison& comparison, std::size_t views,
                                 const Aims& aims) {
    const std::vector<Rows> rows = rows_by_config(comparison, views);
    std::vector<std::optional<double>> bounds;
    for (const Limit& limit : aims.limits) {
        bounds.push_back(bound_of(limit, comparison, rows));
    }
    std::vector<DesignVerdict> verdicts(rows.size());
    for (std::size_t c = 0; c < rows.size(); ++c) {
        if (!rows[c].empty()) {
            for (const Aim& goal : aims.goals) {
                verdicts[c].goals.push_back(value_of(goal, rows[c]));
            }
            check_limits(aims.limits, bounds, rows[c], verdicts[c]);
        }
    }
    mark_front(aims.goals, verdicts);
    return verdicts;
}

std::string within_words(const DesignVerdict& verdict) {
    std::string words;
    for (const std::string& limit : verdict.broken) {
        words += (words.empty() ? "" : "; ") + limit;
    }
    return !verdict.judged ? "" : words.empty() ? "yes" : words;
}

Goals goals_of(const DesignVerdict& verdict) {
    Goals goals;
    for (const std::optional<double>& goal : verdict.goals) {
        goals.push_back(*goal);
    }
    return goals;
}

Goals costs_of(const Goals& goals, const std::vector<Aim>& wanted) {
    Goals costs = goals;
    for (std::size_t g = 0; g < goals.size(); ++g) {
        if (wanted[g].better == Direction::Maximise) {
            costs[g] = -goals[g];
        }
    }
    return costs;
}

} // namespace degs::sim
