// SPDX-License-Identifier: Apache-2.0
#include "cost/clock_limits.hpp"

#include <algorithm>
#include <cmath>

#include "config/config_words.hpp"

namespace degs::cost {
namespace {

std::string hundredths(double value) {
    constexpr double kHundred = 100;
    return config_words::number(std::floor(value * kHundred) / kHundred);
}

} // namespace

ClockEstimate::ClockEstimate(std::vector<ClockLimit> limits, double fo4_per_ns, double clock_ghz)
    : limits_(std::move(limits)), fo4_per_ns_(fo4_per_ns), clock_ghz_(clock_ghz) {
    std::stable_sort(
        limits_.begin(), limits_.end(),
        [this](const ClockLimit& a, const ClockLimit& b) { return ghz_of(a) < ghz_of(b); });
}

std::optional<double> ClockEstimate::feasible_ghz() const {
    return limits_.empty() ? std::nullopt : std::optional<double>(ghz_of(limits_.front()));
}

std::string ClockEstimate::words(const std::string& node) const {
    if (limits_.empty()) {
        return config_words::number(clock_ghz_) +
               " GHz as configured; there is no RTL of this design";
    }
    std::string slow;
    for (const ClockLimit& limit : limits_) {
        if (ghz_of(limit) >= clock_ghz_) {
            break;
        }
        slow += (slow.empty() ? ": " : ", ") + limit.block + " " + hundredths(ghz_of(limit)) +
                (limit.cure.empty() ? "" : " (" + limit.cure + ")");
    }
    return "our RTL reaches " + hundredths(*feasible_ghz()) + " of " +
           config_words::number(clock_ghz_) + " GHz in " + node +
           " by synthesis, a bound of this RTL and not of the design" + slow;
}

void ClockEstimate::describe(StatsVisitor& visitor) const {
    visitor.real(
        "feasible_ghz", feasible_ghz(), "GHz",
        "Clock that our RTL reaches by synthesis in the design's node, without wires: a "
        "bound of this RTL, not of the design; null if there is no RTL of the design, as of "
        "the baselines.");
    visitor.text("limited_by", limits_.empty() ? "" : limits_.front().block,
                 "The logic that allows no more.");
    const bool slow = !limits_.empty() && ghz_of(limits_.front()) < clock_ghz_;
    visitor.text("cure", slow ? limits_.front().cure : "",
                 "A value of a key with which it reaches clock_ghz; empty if it does, or if no key "
                 "helps.");
}

} // namespace degs::cost
