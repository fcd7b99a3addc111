// SPDX-License-Identifier: Apache-2.0
// The bandwidth from which more of it gains little.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/search/search_step.hpp"
#include "sim/study/axis.hpp"
#include "sim/sweep/design_space.hpp"

namespace degs::sim {

/// Bandwidths, each a tenth more than the one before, in GB/s.
struct BandwidthSteps {
    Axis axis;                    ///< the keys that set them
    std::vector<double> gb_per_s; ///< by position
};

/// From a 64th of the design's bandwidth to 64 times as much, as far as its memory has them: the
/// bandwidth of a bus, or the data rate of an LPDDR5 memory, whose timing stays in clock cycles.
BandwidthSteps bandwidth_steps(const RunConfig& design);

/// What is known of where 10 % more bandwidth begin to gain less than 1 %.
struct BandwidthThreshold {
    /// GB/s, by interpolation; empty if there is none within the steps.
    std::optional<double> gb_per_s;
    /// The last step that gains more, and the first behind it that gains less.
    double low = 0, high = 0;
    std::optional<double> estimated; ///< of the analytic model, GB/s
    double latency_ms = 0;           ///< at `high`
    std::size_t simulated = 0;       ///< bandwidths
    std::string none;                ///< why there is no threshold: a sentence
};

/// Finds the threshold of one design on one view: estimates say where to look, and simulations of
/// neighbouring steps narrow it down. Where the estimates are off, they say how far to go on.
class BandwidthSearch : public SearchSteps {
public:
    /// The space has the axis of the steps. Its plan, which has the design, wants the latency. All
    /// outlive this object.
    BandwidthSearch(DesignSpace& space, const StudyPlan& plan, const BandwidthSteps& steps);

    std::optional<Step> next() override;
    void take(const StepResults& results) override;

    /// Valid after the end.
    const BandwidthThreshold& threshold() const { return threshold_; }
    const StepResults& results() const { return results_; }

private:
    using Latencies = std::map<std::size_t, double>; ///< by position, ms
    Step step_of(const std::vector<std::size_t>& positions, PartRuns runs);
    std::optional<std::size_t> variant_of(std::size_t position);
    /// Adds the position and the next one to those that are run, if they exist.
    std::optional<Step> run_at(std::size_t position);
    std::optional<Step> next_simulations();
    void conclude(std::size_t low, std::size_t high);

    DesignSpace& space_;
    const StudyPlan& plan_;
    const BandwidthSteps& steps_;
    bool estimating_ = false;
    Latencies estimated_, found_;
    std::set<std::size_t> tried_;              ///< positions that were simulated, or failed
    std::map<std::size_t, std::size_t> asked_; ///< positions of the last step, by variant
    BandwidthThreshold threshold_;
    StepResults results_;
};

} // namespace degs::sim
