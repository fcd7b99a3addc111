// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/search.hpp"

#include <algorithm>
#include <cmath>
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
void check_value(const std::string& design, const Aim& goal, const std::optional<double>& value) {
    if (!value) {
        throw InputError("'" + design + "' has no " + goal.name + ", so it cannot be a goal.");
    }
    if (!(*value > 0) || std::isinf(*value)) {
        throw InputError("'" + design + "' has the " + goal.name + " " +
                         config_words::number(*value) +
                         ", but a goal must be above 0 and finite, because it is the geometric "
                         "mean over the views.");
    }
}

std::size_t views_of(const StudyPlan& plan) {
    return plan.points.size() / plan.variants.size();
}

/// The designs of a plan that ran on all views.
std::vector<Candidate> candidates_of(const StudyPlan& part, const SweepResults& results,
                                     const std::vector<std::size_t>& variants) {
    for (const ComparisonRow& row : results.comparison.rows) {
        for (const Aim& goal : part.aims.goals) {
            check_value(part.variants[row.config].name, goal, goal.expression.value(row.measures));
        }
    }
    const std::vector<DesignVerdict> verdicts =
        judge(results.comparison, views_of(part), part.aims);
    std::vector<Candidate> candidates;
    for (std::size_t v = 0; v < verdicts.size(); ++v) {
        if (!verdicts[v].has_goals()) {
            continue;
        }
        if (!verdicts[v].judged) {
            throw InputError("'" + part.variants[v].name +
                             "', or a baseline of its limits, has "
                             "no value for one of the limits, so they cannot be looked at.");
        }
        Candidate candidate{variants[v], {}, verdicts[v]};
        for (const std::optional<double>& goal : verdicts[v].goals) {
            candidate.goals.push_back(*goal);
        }
        candidates.push_back(std::move(candidate));
    }
    return candidates;
}

/// Whether a goal or limit compares images with the reference.
bool judges_images(const Aims& aims) {
    const std::vector<Measure> measures = measures_in(aims);
    return std::any_of(measures.begin(), measures.end(),
                       [](Measure measure) { return name_of(measure).rfind("image.", 0) == 0; });
}

/// Runs `variants` of the plan on smaller images. Empty after Ctrl-C.
std::optional<Rung> run_rung(const StudyPlan& plan, const std::vector<std::size_t>& variants,
                             int divisor, const std::string& folder,
                             std::optional<Failure>& failure) {
    StudyPlan part = part_of(plan, variants, divisor);
    part.request.reference = plan.request.reference && (divisor == 1 || judges_images(plan.aims));
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
    rung.candidates = candidates_of(part, results, variants);
    return rung;
}

/// The designs with which others are compared, which run on every rung.
std::vector<std::size_t> kept_variants(const StudyPlan& plan) {
    std::vector<std::size_t> kept{plan.baseline};
    for (const std::string& name : designs_in(plan.aims)) {
        const auto found =
            std::find_if(plan.variants.begin(), plan.variants.end(),
                         [&name](const StudyVariant& variant) { return variant.name == name; });
        if (found == plan.variants.end()) {
            std::vector<std::string> names;
            for (const StudyVariant& variant : plan.variants) {
                names.push_back(variant.name);
            }
            const std::string near = config_words::nearest(name, names);
            throw InputError("A limit compares with " + config_words::quote(name) +
                             ", but no point of the study has this name" +
                             (near.empty() ? "; a design has it where every key has the value of "
                                             "its own file."
                                           : "; it may mean " + config_words::quote(near) + "."));
        }
        kept.push_back(static_cast<std::size_t>(found - plan.variants.begin()));
    }
    return kept;
}

/// Positions of the best `count`: of those within the limits, and where they are too few, of those
/// that miss them least.
std::vector<std::size_t> best_candidates(const Rung& rung, const Aims& aims, std::size_t count) {
    std::vector<std::size_t> within;
    std::vector<std::size_t> outside;
    std::vector<Goals> costs;
    for (std::size_t c = 0; c < rung.candidates.size(); ++c) {
        const Candidate& candidate = rung.candidates[c];
        (candidate.verdict.is_within() ? within : outside).push_back(c);
        if (candidate.verdict.is_within()) {
            costs.push_back(costs_of(candidate.goals, aims.goals));
        }
    }
    std::vector<std::size_t> best;
    for (const std::size_t position : best_of(costs, count)) {
        best.push_back(within[position]);
    }
    std::stable_sort(outside.begin(), outside.end(), [&rung](std::size_t a, std::size_t b) {
        return rung.candidates[a].verdict.excess < rung.candidates[b].verdict.excess;
    });
    outside.resize(std::min(outside.size(), count - best.size()));
    best.insert(best.end(), outside.begin(), outside.end());
    return best;
}

/// The variants that go on, and those with which results are compared.
std::vector<std::size_t> survivors(const Rung& rung, const StudyPlan& plan,
                                   const SearchOptions& options) {
    const std::size_t count = std::max(options.least, rung.candidates.size() / options.share);
    std::vector<std::size_t> variants = kept_variants(plan);
    for (const std::size_t position : best_candidates(rung, plan.aims, count)) {
        variants.push_back(rung.candidates[position].variant);
    }
    std::sort(variants.begin(), variants.end());
    variants.erase(std::unique(variants.begin(), variants.end()), variants.end());
    return variants;
}

/// Why runs of this request do not have a measure: "needs ..."; empty if they do.
std::string lack_of(Measure measure, const CompareRequest& request) {
    const auto starts = [measure](const char* section) {
        return name_of(measure).rfind(section, 0) == 0;
    };
    const bool path = starts("throughput_") || starts("ratio.throughput");
    return path && request.path.frames < kFramesOfThroughput
               ? "needs a camera path of at least 3 frames ('frames' of the study, or --frames)"
           : starts("image.") && (!request.reference || request.sampling)
               ? "needs reference images, which this study does not make"
           : starts("dram.") && request.array_only ? "does not exist for the arrays alone"
                                                   : "";
}

/// Throws InputError for a measure that the runs do not have; `part` is "a goal" or "in a limit".
void check_measures(const Aims& aims, const std::string& part, const CompareRequest& request) {
    const std::string end = ", so it cannot be " + part;
    for (const Measure measure : measures_in(aims)) {
        if (request.analytic && !is_estimated(measure)) {
            throw InputError("Estimates have no " + name_of(measure) + end +
                             " with the fidelity analytic; allowed are " +
                             config_words::list(allowed_goals(is_estimated)) + ".");
        }
        if (const std::string lack = lack_of(measure, request); !lack.empty()) {
            std::string why = "The study has no " + name_of(measure) + end;
            why += "; it " + lack + ".";
            throw InputError(why);
        }
    }
}

} // namespace

void check_aims(const StudyPlan& plan) {
    check_measures({plan.aims.goals, {}}, "a goal", plan.request);
    check_measures({{}, plan.aims.limits}, "in a limit", plan.request);
    kept_variants(plan);
}

Search search(const StudyPlan& plan, const SearchOptions& options, const std::string& out,
              std::optional<Failure>& failure) {
    check_aims(plan);
    Search found;
    std::vector<std::size_t> variants(plan.variants.size());
    std::iota(variants.begin(), variants.end(), 0);
    for (int r = 0; r < options.rungs; ++r) {
        const int divisor = 1 << (options.rungs - 1 - r);
        std::optional<Failure> rung_failure;
        std::optional<Rung> rung =
            run_rung(plan, variants, divisor,
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
