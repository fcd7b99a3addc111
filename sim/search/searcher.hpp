// SPDX-License-Identifier: Apache-2.0
// Who decides which designs a search runs next.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/goals/judgement.hpp"
#include "sim/results/comparison.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// Designs that are run together.
struct Step {
    std::vector<std::size_t> variants; ///< of the whole plan, in ascending order, with the baseline
    PartChange change;
    std::string folder;  ///< below that of the search; empty: the folder itself
    bool results = true; ///< whether the folder gets tables and a page of these designs
    std::string spent{}; ///< so far, for the page, which adds the simulated cycles: "9 simulated"
};

/// A design in a rung.
struct Candidate {
    std::size_t variant = 0; ///< of the whole plan
    DesignVerdict verdict{}; ///< among the designs of its rung; estimates may lack goals
};

/// Designs that are compared with each other: what a step has found.
struct Rung {
    PartChange change;
    std::vector<Candidate> candidates;
    std::vector<FailedRun> failed;
    std::vector<std::string> warnings{}; ///< of the runs, each once
    double cycles = 0;                   ///< simulated for single frames of all these designs
};

/// What a search believed of a design when it chose to simulate it, in the order of the goals.
struct Belief {
    std::size_t variant = 0;
    int round = 0;                            ///< from 1
    std::vector<std::optional<double>> goals; ///< empty: there was neither estimate nor neighbour
};

class Searcher {
public:
    Searcher() = default;
    Searcher(const Searcher&) = delete;
    Searcher& operator=(const Searcher&) = delete;
    virtual ~Searcher() = default;

    /// What to run next; empty at the end.
    virtual std::optional<Step> next() = 0;
    /// What that found, before next() is asked again.
    virtual void take(const Rung& rung) = 0;
    /// The results of the search: the rung that was asked for last. Valid after the end.
    virtual const std::vector<Rung>& rungs() const = 0;
    /// What it believed of the designs that it simulated; a search may believe nothing.
    virtual std::vector<Belief> beliefs() const { return {}; }
    /// What the search was given, such as {"budget", 40}, and how it ended.
    struct Facts {
        std::string method;
        std::vector<std::pair<std::string, std::uint64_t>> options;
        std::string end; ///< why it ended: a sentence, or empty
    };
    virtual Facts facts() const = 0;
};

/// By how much a design misses the limits, and a little for one that only touches them; 0: nothing.
double excess_of(const DesignVerdict& verdict);

/// The designs with which others are compared, which are in every step. Throws InputError for a
/// limit that compares with a design that the plan does not have.
std::vector<std::size_t> kept_variants(const StudyPlan& plan);

} // namespace degs::sim
