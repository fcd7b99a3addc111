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

/// The clock that our RTL of a design reaches by docs/synthesis.md, without wires. Only what a
/// design cannot divide freely limits it. It is a bound of this RTL in a node, not of the design: a
/// better circuit may reach more, and designs without RTL have none.
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
    /// One line: the clock that is reached in `node`, and for each block that is slower than the
    /// design's clock the key that would help; or that nothing is known.
    std::string words(const std::string& node) const;
    /// The section `clock` of a report.
    void describe(StatsVisitor& visitor) const;

private:
    std::vector<ClockLimit> limits_;
    double fo4_per_ns_, clock_ghz_;
};

} // namespace degs::cost
