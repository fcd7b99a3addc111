// SPDX-License-Identifier: Apache-2.0
// Which designs are within the limits, and which of these no other beats.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/goals/goals.hpp"
#include "sim/goals/pareto.hpp"
#include "sim/results/comparison.hpp"

namespace degs::sim {

/// What a limit is about; either number is empty where its measures do not exist.
struct LimitValue {
    std::optional<double> value, bound;
};

/// What is known of a design.
struct DesignVerdict {
    std::vector<std::optional<double>> goals; ///< over the views; empty without all views
    std::vector<LimitValue> limits;           ///< over the views; empty without all views
    bool judged = false;                      ///< whether the limits could be looked at
    std::vector<std::string> broken;          ///< limits
    double excess = 0;                        ///< sum of |value / bound - 1| over these
    bool on_front = false;                    ///< within the limits, and nobody beats it

    bool has_goals() const;
    bool is_within() const { return judged && broken.empty(); }
};

/// Whether a value is within the limit.
bool holds(const Limit& limit, double value, double bound);

/// |value / bound - 1|, by which a value misses a limit that it breaks.
double excess_of(double value, double bound);

/// By configuration. Those with fewer than `views` runs are not judged.
std::vector<DesignVerdict> judge(const Comparison& comparison, std::size_t views, const Aims& aims);

/// "yes", the limits that are broken, or nothing for what is not judged.
std::string within_words(const DesignVerdict& verdict);

/// The goals of those that have all of them.
Goals goals_of(const DesignVerdict& verdict);

/// The goals as costs: the smaller, the better, and ratios of two costs are those of the goals.
Goals costs_of(const Goals& goals, const std::vector<Aim>& wanted);

} // namespace degs::sim
