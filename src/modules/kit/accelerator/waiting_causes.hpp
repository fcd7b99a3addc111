// SPDX-License-Identifier: Apache-2.0
// What the array of an accelerator waited for: a stage, or the memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/kit/accelerator/accelerator_result.hpp"

namespace degs {

/// The facts behind the losses of a run and behind what limits it. It refers to the result, which
/// must outlive it.
class WaitingCauses {
public:
    /// A stage or the memory is the cause of waiting if it is busy for this share of the time.
    static constexpr double kBusy = 0.6;
    /// A part of the time before the first task is its cause if it is that long.
    static constexpr double kLong = 0.3;

    explicit WaitingCauses(const AcceleratorResult& run) : run_(run) {}

    bool has_limited_memory() const { return run_.memory_gb_per_s > 0; }
    /// Date of the first task; the whole run if there is none.
    Cycle before_first() const { return run_.window.empty() ? run_.cycles : run_.window.first; }

    /// A part of what was done before the first task. Memory and stages work at the same time.
    struct Part {
        std::string name;
        double share; ///< of the time before the first task
    };
    /// Memory, then the stages from the first to the last.
    std::vector<Part> preparation() const;
    /// Whether the first task waited longest for the memory.
    bool prepares_for_memory() const;

    /// Whether the data bus was busy while the array worked.
    bool is_memory_busy() const { return memory_in_window() >= kBusy; }
    /// "memory" or the stage for which the array starved; empty if nothing was busy enough.
    std::string starved_for() const;

    /// Share of the PE-cycles of the run in which the array waited for the bandwidth of memory:
    /// before the first task, starved or blocked. Empty for memory without limit.
    std::optional<double> lost_for_memory() const;
    /// Whether the data bus was busy, and busier than every stage, while the array worked.
    bool is_memory_busiest() const;

private:
    /// What a stage or a stream did while the array worked, as a part of all that it did: the first
    /// task waits for the rest.
    static double later(double prepares, double frames) { return 1 - prepares / frames; }
    double frames() const;
    double memory_in_window() const;
    double in_window(const StageUse& stage) const;

    const AcceleratorResult& run_;
};

/// From this share on the run is limited by memory.
constexpr double kMemoryBound = 0.5;

/// "memory" if more than kMemoryBound of the PE-cycles of the run were lost for it, or if its data
/// bus was busier than every stage while the array worked; else the busiest stage. Empty without
/// stages.
std::string limiting_stage(const AcceleratorResult& result);

} // namespace degs
