// SPDX-License-Identifier: Apache-2.0
// A search for the designs that nobody beats in two goals, by successive halving: all designs on
// small images, the better part on larger ones, what is left on the images that were asked for
// (K. Jamieson, A. Talwalkar, Non-stochastic Best Arm Identification, AISTATS 2016).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/process/failure.hpp"
#include "sim/report/measures.hpp"
#include "sim/sweep/study_plan.hpp"
#include "sim/sweep/sweep_results.hpp"

namespace degs::sim {

/// Two numbers. The functions below take them as costs, which shall be small.
using Goals = std::array<double, 2>;

/// Positions of those that no other beats: none is at least as good in both goals and better in
/// one. In the order of the first goal. Of equal ones the first counts.
std::vector<std::size_t> pareto_front(const std::vector<Goals>& goals);

/// Positions of the best `count`, at most all: the front, then the front of the rest, and so on. Of
/// the last front that does not fit those are taken that lie farthest from their neighbours, its
/// ends first. In ascending order.
std::vector<std::size_t> best_of(const std::vector<Goals>& goals, std::size_t count);

/// Spearman's correlation of ranks of two lists of the same length; empty for fewer than three.
std::optional<double> rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

struct SearchOptions {
    int rungs = 3;         ///< images have 1 / 2^(rungs - 1) of their sides in the first
    int share = 3;         ///< one of so many designs goes on to the next rung
    std::size_t least = 8; ///< designs that go on at least
    std::array<Measure, 2> goals{Measure::AreaMm2, Measure::LatencyMs};
};

/// Throws InputError for a goal without a direction, and for one that is given twice.
void check_goals(const SearchOptions& options);

/// Throws InputError for a goal that runs of this request do not have.
void check_goals(const SearchOptions& options, const CompareRequest& request);

/// The goals as costs: the smaller, the better, and ratios of two costs are those of the goals.
Goals costs_of(const Goals& goals, const SearchOptions& options);

/// A design in a rung.
struct Candidate {
    std::size_t variant = 0; ///< of the whole plan
    Goals goals{};           ///< geometric means over the views
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
/// they could not be made smaller then, and if a design does not have the goals.
Search search(const StudyPlan& plan, const SearchOptions& options, const std::string& out,
              std::optional<Failure>& failure);

} // namespace degs::sim
