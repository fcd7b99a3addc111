// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stats/statistics.hpp"

namespace degs::cost {

/// Logic that must be over within a number of cycles.
struct ClockLimit {
    std::string block; ///< "loop of a pixel"
    double fo4 = 0;    ///< longest path, by synthesis
    int cycles = 1;    ///< that the design gives it
    std::string cure;  ///< an assignment with which it reaches the clock; empty: no key helps
};

/// The clock that a design can reach by docs/synthesis.md, without wires. Only what a design cannot
/// divide freely limits it.
class ClockEstimate {
public:
    /// `fo4_per_ns` of LogicLaws; `clock_ghz` is that of the design.
    ClockEstimate(std::vector<ClockLimit> limits, double fo4_per_ns, double clock_ghz);

    /// The limits, the lowest clock first.
    const std::vector<ClockLimit>& limits() const { return limits_; }
    /// GHz that a limit allows.
    double ghz_of(const ClockLimit& limit) const { return limit.cycles * fo4_per_ns_ / limit.fo4; }
    /// Nothing if no part of the design has been synthesised.
    std::optional<double> feasible_ghz() const;
    /// One line: the clock that can be reached, and for each block that is too slow the key that
    /// would help. Empty if the design reaches its clock, or if nothing is known.
    std::string warning() const;
    /// The section `clock` of a report.
    void describe(StatsVisitor& visitor) const;

private:
    std::vector<ClockLimit> limits_;
    double fo4_per_ns_, clock_ghz_;
};

} // namespace degs::cost
