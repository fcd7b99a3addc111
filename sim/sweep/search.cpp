// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/analytic/analytic_run.hpp"
#include "sim/sweep/sweep_session.hpp"

namespace degs::sim {
namespace {

constexpr int kFramesOfThroughput = 3; ///< docs/compare.md

/// Goals are geometric means on logarithmic axes.
void check_value(const std::string& design, Measure goal, const std::optional<double>& value) {
    if (!value) {
        throw InputError("'" + design + "' has no " + name_of(goal) + ", so it cannot be a goal.");
    }
    if (!(*value > 0) || std::isinf(*value)) {
        throw InputError("'" + design + "' has the " + name_of(goal) + " " +
                         config_words::number(*value) +
                         ", but a goal must be above 0 and finite, because it is the geometric "
                         "mean over the views.");
    }
}

/// The goals of the plan's variants, by their numbers in the rung; empty for those that failed.
std::vector<std::optional<Goals>> goals_of(const StudyPlan& part, const SweepResults& results,
                                           const SearchOptions& options) {
    std::vector<std::size_t> views(part.variants.size(), 0);
    std::vector<Goals> first(part.variants.size(), Goals{});
    std::vector<Goals> logs(part.variants.size(), Goals{}); // of the ratios to the first view
    for (const ComparisonRow& row : results.comparison.rows) {
        const bool is_first = views[row.config]++ == 0;
        for (std::size_t g = 0; g < options.goals.size(); ++g) {
            const std::optional<double>& value = row.measures[options.goals.at(g)];
            check_value(part.variants[row.config].name, options.goals.at(g), value);
            double& base = first[row.config].at(g);
            base = is_first ? *value : base;
            logs[row.config].at(g) += std::log(*value / base);
        }
    }
    const std::size_t wanted = part.points.size() / part.variants.size();
    std::vector<std::optional<Goals>> goals(part.variants.size());
    for (std::size_t v = 0; v < goals.size(); ++v) {
        if (views[v] == wanted) {
            const auto count = static_cast<double>(wanted);
            // Equal values, such as areas, come out as they are.
            goals[v] = Goals{first[v][0] * std::exp(logs[v][0] / count),
                             first[v][1] * std::exp(logs[v][1] / count)};
        }
    }
    return goals;
}

/// Whether a goal compares images with the reference.
bool judges_images(const SearchOptions& options) {
    return std::any_of(options.goals.begin(), options.goals.end(),
                       [](Measure goal) { return name_of(goal).rfind("image.", 0) == 0; });
}

/// Runs `variants` of the plan on smaller images. Empty after Ctrl-C.
std::optional<Rung> run_rung(const StudyPlan& plan, const std::vector<std::size_t>& variants,
                             int divisor, const SearchOptions& options, const std::string& folder,
                             std::optional<Failure>& failure) {
    StudyPlan part = part_of(plan, variants, divisor);
    part.request.reference = plan.request.reference && (divisor == 1 || judges_images(options));
    const PointStore store(folder, part);
    SweepSession session(part, store, {0, part.points.size()});
    const bool complete = session.run();
    failure = session.failure();
    const SweepResults results = read_results(part, store);
    write_results(part, results, store.folder());
    if (!complete) {
        return {};
    }
    Rung rung;
    rung.divisor = divisor;
    rung.warnings = results.warnings;
    rung.failed = results.comparison.failed;
    const auto goals = goals_of(part, results, options);
    for (std::size_t v = 0; v < variants.size(); ++v) {
        if (goals[v]) {
            rung.candidates.push_back({variants[v], *goals[v]});
        }
    }
    return rung;
}

/// The variants that go on, and the baseline, with which results are compared.
std::vector<std::size_t> survivors(const Rung& rung, const StudyPlan& plan,
                                   const SearchOptions& options) {
    std::vector<Goals> goals;
    for (const Candidate& candidate : rung.candidates) {
        goals.push_back(costs_of(candidate.goals, options));
    }
    const std::size_t count = std::max(options.least, goals.size() / options.share);
    std::vector<std::size_t> variants{plan.baseline};
    for (const std::size_t position : best_of(goals, count)) {
        variants.push_back(rung.candidates[position].variant);
    }
    std::sort(variants.begin(), variants.end());
    variants.erase(std::unique(variants.begin(), variants.end()), variants.end());
    return variants;
}

/// Names of the measures that can be goals, of those that runs have.
std::vector<std::string> allowed_goals(const std::function<bool(Measure)>& has) {
    std::vector<std::string> allowed;
    for_each_measure([&](Measure measure) {
        if (direction_of(measure) != Direction::None && has(measure)) {
            allowed.push_back(name_of(measure));
        }
    });
    return allowed;
}

} // namespace

void check_goals(const SearchOptions& options) {
    for (const Measure goal : options.goals) {
        if (direction_of(goal) == Direction::None) {
            throw InputError("--goals names '" + name_of(goal) +
                             "', of which neither small nor large values are better; allowed are " +
                             config_words::list(allowed_goals([](Measure) { return true; })) + ".");
        }
    }
    if (options.goals[0] == options.goals[1]) {
        throw InputError("--goals names '" + name_of(options.goals[0]) +
                         "' twice, but a search needs two different measures.");
    }
}

void check_goals(const SearchOptions& options, const CompareRequest& request) {
    const auto starts = [](Measure goal, const char* section) {
        return name_of(goal).rfind(section, 0) == 0;
    };
    for (const Measure goal : options.goals) {
        if (request.analytic && !is_estimated(goal)) {
            throw InputError("Estimates have no " + name_of(goal) +
                             ", so it cannot be a goal with the fidelity analytic; allowed are " +
                             config_words::list(allowed_goals(is_estimated)) + ".");
        }
        const bool path = starts(goal, "throughput_") || starts(goal, "ratio.throughput");
        const std::string lack =
            path && request.path.frames < kFramesOfThroughput
                ? "needs a camera path of at least 3 frames ('frames' of the study, or --frames)"
            : starts(goal, "image.") && (!request.reference || request.sampling)
                ? "needs reference images, which this study does not make"
            : starts(goal, "dram.") && request.array_only ? "does not exist for the arrays alone"
                                                          : "";
        if (!lack.empty()) {
            throw InputError("The study has no " + name_of(goal) + ", so it cannot be a goal; it " +
                             lack + ".");
        }
    }
}

Goals costs_of(const Goals& goals, const SearchOptions& options) {
    Goals costs = goals;
    for (std::size_t g = 0; g < goals.size(); ++g) {
        if (direction_of(options.goals.at(g)) == Direction::Maximise) {
            costs.at(g) = -goals.at(g);
        }
    }
    return costs;
}

Search search(const StudyPlan& plan, const SearchOptions& options, const std::string& out,
              std::optional<Failure>& failure) {
    check_goals(options, plan.request);
    Search found;
    std::vector<std::size_t> variants(plan.variants.size());
    std::iota(variants.begin(), variants.end(), 0);
    for (int r = 0; r < options.rungs; ++r) {
        const int divisor = 1 << (options.rungs - 1 - r);
        std::optional<Failure> rung_failure;
        std::optional<Rung> rung =
            run_rung(plan, variants, divisor, options,
                     divisor == 1 ? out : out + "/rung-" + std::to_string(r + 1), rung_failure);
        failure = rung_failure ? rung_failure : failure;
        if (!rung) {
            found.complete = false;
            return found;
        }
        variants = survivors(*rung, plan, options);
        found.rungs.push_back(std::move(*rung));
    }
    return found;
}

} // namespace degs::sim
