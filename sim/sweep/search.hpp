// SPDX-License-Identifier: Apache-2.0
// A search for the designs that nobody beats in the goals of a plan, by successive halving: all
// designs on small images, the better part on larger ones, what is left on the images that were
// asked for (K. Jamieson, A. Talwalkar, Non-stochastic Best Arm Identification, AISTATS 2016).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/goals/judgement.hpp"
#include "sim/process/failure.hpp"
#include "sim/sweep/study_plan.hpp"
#include "sim/sweep/sweep_results.hpp"

namespace degs::sim {

struct SearchOptions {
    int rungs = 3;         ///< images have 1 / 2^(rungs - 1) of their sides in the first
    int share = 3;         ///< one of so many designs goes on to the next rung
    std::size_t least = 8; ///< designs that go on at least
};

/// What is searched for, if nobody says anything else.
constexpr const char* kUsualGoals = "area_mm2,latency_ms";

/// Throws InputError for goals and limits that runs of this plan do not have.
void check_aims(const StudyPlan& plan);

/// A design in a rung.
struct Candidate {
    std::size_t variant = 0; ///< of the whole plan
    Goals goals{};           ///< over the views
    DesignVerdict verdict{}; ///< among the designs of its rung
};

struct Rung {
    int divisor = 1; ///< of the sides of the images
    std::vector<Candidate> candidates;
    std::vector<FailedRun> failed;
    std::vector<std::string> warnings{}; ///< of the runs, each once
};

/// What a search has found; the last rung has the images that were asked for.
struct Search {
    std::vector<Rung> rungs;
    bool complete = true; ///< false after Ctrl-C
};

/// Runs the rungs, the last as a study in the folder `out`, the others in folders below it; an
/// interrupted search goes on there. Throws InputError if the study says no size of images, because
/// they could not be made smaller then, and if a design does not have what the goals and limits
/// need.
Search search(const StudyPlan& plan, const SearchOptions& options, const std::string& out,
              std::optional<Failure>& failure);

} // namespace degs::sim
