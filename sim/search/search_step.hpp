// SPDX-License-Identifier: Apache-2.0
// What a search runs next, and what it has found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/goals/judgement.hpp"
#include "sim/results/comparison.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// Designs that are run together.
struct Step {
    std::vector<std::size_t> variants; ///< of the whole plan, in ascending order, with the baseline
    PartRuns runs = PartRuns::AsPlanned;
    std::string folder;  ///< below that of the search; empty: the folder itself
    bool results = true; ///< whether the folder gets tables and a page of these designs
    std::string spent{}; ///< so far, for the page, which adds the simulated cycles: "9 simulated"
};

/// A design in a step.
struct Candidate {
    std::size_t variant = 0; ///< of the whole plan
    DesignVerdict verdict{}; ///< among the designs of its step; estimates may lack goals
};

/// Designs that are compared with each other: what a step has found.
struct StepResults {
    std::vector<Candidate> candidates;
    std::vector<FailedRun> failed;
    std::vector<std::string> warnings{}; ///< of the runs, each once
    double cycles = 0;                   ///< simulated for single frames of all these designs
};

/// Decides what runs next by what was found before: the same steps for the same answers, so that an
/// interrupted search finds its results again.
class SearchSteps {
public:
    SearchSteps() = default;
    virtual ~SearchSteps() = default;
    SearchSteps(const SearchSteps&) = delete;
    SearchSteps& operator=(const SearchSteps&) = delete;
    /// What to run next; empty at the end.
    virtual std::optional<Step> next() = 0;
    /// What that found, before next() is asked again.
    virtual void take(const StepResults& results) = 0;
};

/// What a search believed of a design when it chose to simulate it, in the order of the goals.
struct Belief {
    std::size_t variant = 0;
    int round = 0;                            ///< from 1
    std::vector<std::optional<double>> goals; ///< empty: there was neither estimate nor neighbour
};

/// What a search has found.
struct Search {
    std::optional<StepResults> estimates; ///< empty: there are none, or they are the results
    StepResults results;                  ///< of what the plan asks for
    std::vector<Belief> beliefs;          ///< of the designs that were simulated
    std::vector<std::pair<std::string, std::uint64_t>> options; ///< such as {"budget", 40}
    std::string no_estimates; ///< why nothing was estimated: a sentence, or empty
    std::string end;          ///< why it ended: a sentence, or empty
};

/// By how much a design misses the limits, and a little for one that only touches them; 0: nothing.
double excess_of(const DesignVerdict& verdict);

/// The designs with which others are compared, which are in every step. Throws InputError for a
/// limit that compares with a design that the plan does not have.
std::vector<std::size_t> kept_variants(const StudyPlan& plan);

} // namespace degs::sim
