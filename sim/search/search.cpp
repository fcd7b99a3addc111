// SPDX-License-Identifier: Apache-2.0
#include "sim/search/search.hpp"

#include <algorithm>
#include <cmath>

#include "base/grouped_number.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/analytic/analytic_run.hpp"
#include "sim/sweep/sweep_results.hpp"
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

/// The designs of a plan that ran on all views. Of simulations all goals and limits must have
/// values; estimates do not have all.
std::vector<Candidate> candidates_of(const StudyPlan& part, const SweepResults& results,
                                     const Step& step) {
    const bool strict = step.runs == PartRuns::AsPlanned;
    for (const ComparisonRow& row : results.comparison.rows) {
        for (const Aim& goal : part.aims.goals) {
            const std::optional<double> value = goal.expression.value(row.measures);
            if (strict || value) {
                check_value(part.variants[row.config].name, goal, value);
            }
        }
    }
    std::vector<Candidate> candidates;
    for (std::size_t v = 0; v < results.verdicts.size(); ++v) {
        const DesignVerdict& verdict = results.verdicts[v];
        if (verdict.goals.empty() || (strict && !verdict.has_goals())) {
            continue;
        }
        if (strict && !verdict.judged) {
            throw InputError("'" + part.variants[v].name +
                             "', or a baseline of its limits, has "
                             "no value for one of the limits, so they cannot be looked at.");
        }
        candidates.push_back({step.variants[v], verdict});
    }
    return candidates;
}

/// How many cycles were simulated for single frames.
double cycles_of(const Comparison& comparison) {
    double cycles = 0;
    for (const ComparisonRow& row : comparison.rows) {
        cycles += comparison.is_estimated() ? 0 : row.measures[Measure::Cycles].value_or(0);
    }
    return cycles;
}

/// The points that failed, each with its sentence.
std::vector<FailedRun> failed_runs(const StudyPlan& plan, const SweepResults& results) {
    std::vector<FailedRun> runs;
    for (const FailedPoint& failed : results.failed) {
        const StudyPoint& point = plan.points[failed.point];
        runs.push_back({plan.variants[point.variant].name, plan.request.scenes[point.scene],
                        failed.failure.sentence});
    }
    return runs;
}

/// Runs a step, or the part of it that is `mine`. Empty after Ctrl-C.
std::optional<StepResults> run_step(const StudyPlan& plan, const Step& step, SearchPart& mine,
                                    const std::string& out, std::optional<Failure>& failure) {
    const StudyPlan part = part_of(plan, step.variants, step.runs);
    const PointStore store(step.folder.empty() ? out : out + "/" + step.folder, part,
                           Steps::Several);
    SweepSession session(part, store, mine.own_points(part, store, step.folder));
    const bool complete = session.run();
    failure = session.failure();
    if (complete) {
        mine.wait_for_others(store);
    }
    SweepResults results = read_results(part, store, mine.writes() ? Reports::Put : Reports::Leave);
    if (!failure && !results.failed.empty()) { // of another part
        failure = results.failed.front().failure;
    }
    if (!step.spent.empty()) {
        results.spent = step.spent + ", " +
                        grouped(static_cast<std::uint64_t>(cycles_of(results.comparison))) +
                        " cycles simulated";
    }
    if (mine.writes() && (step.results || !complete)) {
        write_results(part, results, store.folder());
        store.drop_other_reports();
    }
    if (!complete) {
        return {};
    }
    StepResults found;
    found.warnings = results.warnings;
    found.failed = failed_runs(part, results);
    found.candidates = candidates_of(part, results, step);
    found.cycles = cycles_of(results.comparison);
    return found;
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

bool search(const StudyPlan& plan, SearchSteps& steps, SearchPart& part, const std::string& out,
            std::optional<Failure>& failure) {
    while (const std::optional<Step> step = steps.next()) {
        std::optional<Failure> of_step;
        const std::optional<StepResults> found = run_step(plan, *step, part, out, of_step);
        failure = of_step ? of_step : failure;
        if (!found) {
            return false;
        }
        steps.take(*found);
    }
    return true;
}

} // namespace degs::sim
