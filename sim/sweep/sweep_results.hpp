// SPDX-License-Identifier: Apache-2.0
// Results of a study for people, programs and spreadsheets.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/goals/judgement.hpp"
#include "sim/process/failure.hpp"
#include "sim/results/comparison.hpp"
#include "sim/sweep/point_store.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// Raised whenever a key of results.json changes its meaning, name or unit.
constexpr int kSweepVersion = 1;

/// Names of the files that a sweep writes beside its points.
std::vector<std::string> sweep_files();

/// Names of what a search adds to them; the first is its document. They tell of the results beside
/// them, and go when these are replaced.
std::vector<std::string> search_files();

struct FailedPoint {
    std::size_t point = 0;
    Failure failure;
};

/// What is known of the points of a study, whoever ran them.
struct SweepResults {
    std::vector<DesignVerdict> verdicts; ///< by variant
    Comparison comparison;               ///< a configuration for each variant, in the plan's order
    std::vector<std::size_t> points;     ///< by row of the comparison
    std::vector<FailedPoint> failed;
    std::size_t missing = 0;           ///< points that are neither finished nor failed
    std::size_t damaged = 0;           ///< of `missing`, points whose file is damaged
    std::vector<std::string> warnings; ///< sentences, each once
    std::string spent;                 ///< by a search, for the page
};

/// Whether reports are put beside the results; only one process of several should do that.
enum class Reports { Put, Leave };

/// Reads the points.
SweepResults read_results(const StudyPlan& plan, const PointStore& store,
                          Reports reports = Reports::Put);

/// results.json, results.csv, index.html, host.csv and bandwidth.svg. All but host.csv depend only
/// on the study. Removes what an earlier search has said of other results.
void write_results(const StudyPlan& plan, const SweepResults& results, const OutputFolder& folder);

/// Says how many points there are, and which ones could not be built or failed.
std::string results_text(const StudyPlan& plan, const SweepResults& results);

} // namespace degs::sim
