// SPDX-License-Identifier: Apache-2.0
// What a study wants of its designs: goals, which shall be small or large, and limits, which must
// hold. docs/explore.md is the manual.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/goals/expression.hpp"

namespace degs::sim {

/// How the values of all views become one.
enum class Fold {
    Mean, ///< geometric
    Worst ///< the largest where small values are better, and the other way round
};

/// A number of a design over all views, which is a goal or has a limit.
struct Aim {
    std::string name; ///< as it was written, without blanks and direction
    Expression expression;
    Fold fold = Fold::Mean;
    Direction better = Direction::None;
};

struct Limit {
    std::string name; ///< as it was written, without blanks
    Aim aim;
    bool at_most = true, or_equal = true; ///< "<=", "<", ">=", ">"
    Expression bound;
};

struct Aims {
    std::vector<Aim> goals;
    std::vector<Limit> limits;
};

constexpr std::size_t kMostGoals = 6;

/// "latency_ms,max:image.psnr_db,worst(energy.nj_per_frame*latency_ms)". Without "max:" or "min:" a
/// goal has the direction of its measures. Throws InputError, which begins with `place`, for
/// mistakes, for a goal without a direction, for one that is given twice, and for too many.
std::vector<Aim> parse_goals(const std::string& text, const std::string& place);

/// "area_mm2<=2.5,latency_ms<=1.02*baseline". Throws InputError, which begins with `place`.
std::vector<Limit> parse_limits(const std::string& text, const std::string& place);

/// All measures that the aims need, each once.
std::vector<Measure> measures_in(const Aims& aims);

/// Names of the designs in `baseline(NAME)`, each once.
std::vector<std::string> designs_in(const Aims& aims);

/// Names of the measures that can be goals by themselves, of those that `has` accepts.
std::vector<std::string> allowed_goals(const std::function<bool(Measure)>& has);

/// "fps (larger is better)".
std::string goal_words(const Aim& goal);

} // namespace degs::sim
