// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/accelerator/waiting_causes.hpp"

#include <algorithm>

#include "base/ratio.hpp"

namespace degs {

double WaitingCauses::frames() const {
    return std::max(1.0, real_of(run_.frames.size()));
}

/// Share of the window of the array in which the data bus was busy.
double WaitingCauses::memory_in_window() const {
    if (!has_limited_memory() || run_.window.empty()) {
        return 0;
    }
    double all = 0, beside = 0;
    for (const StreamUse& stream : run_.streams) {
        const double bytes = real_of(stream.bytes_read + stream.bytes_written);
        all += bytes;
        beside += bytes * later(stream.prepares, frames());
    }
    const double busy = run_.memory_utilization * real_of(run_.memory_window);
    return all > 0 ? busy * beside / all / real_of(run_.window.cycles()) : 0;
}

/// Share of the window of the array in which the units of a stage were busy.
double WaitingCauses::in_window(const StageUse& stage) const {
    return run_.window.empty() ? 0
                               : stage.busy_cycles / stage.units * later(stage.prepares, frames()) /
                                     real_of(run_.window.cycles());
}

std::vector<WaitingCauses::Part> WaitingCauses::preparation() const {
    const double cycles = real_of(before_first());
    std::vector<Part> parts;
    double bytes = 0;
    for (const StreamUse& stream : run_.streams) {
        bytes += stream.prepares * real_of(stream.bytes_read + stream.bytes_written);
    }
    if (has_limited_memory()) {
        parts.push_back(
            {"memory", bytes / run_.memory_gb_per_s * run_.clock_ghz / frames() / cycles});
    }
    for (const StageUse& stage : run_.stages) {
        parts.push_back(
            {stage.name, stage.prepares * stage.busy_cycles / stage.units / frames() / cycles});
    }
    if (run_.binning_cycles > 0) {
        parts.push_back({"binning", run_.binning_cycles / frames() / cycles});
    }
    return parts;
}

bool WaitingCauses::prepares_for_memory() const {
    if (!has_limited_memory() || before_first() == 0) {
        return false;
    }
    const std::vector<Part> parts = preparation();
    const double memory = parts.front().share;
    return memory >= kLong && std::all_of(parts.begin(), parts.end(), [memory](const Part& part) {
               return part.share <= memory;
           });
}

std::string WaitingCauses::starved_for() const {
    std::string busiest;
    double most = 0;
    for (const StageUse& stage : run_.stages) {
        if (!stage.array && in_window(stage) > most) {
            most = in_window(stage);
            busiest = stage.name;
        }
    }
    return is_memory_busy() && memory_in_window() >= most ? "memory" : most >= kBusy ? busiest : "";
}

std::optional<double> WaitingCauses::lost_for_memory() const {
    const double all = real_of(run_.cycles) * run_.pes;
    if (!has_limited_memory() || all <= 0) {
        return {};
    }
    double lost = prepares_for_memory() ? real_of(before_first()) * run_.pes : 0;
    lost += starved_for() == "memory" ? real_of(run_.slots[Slot::Starved]) : 0;
    lost += is_memory_busy() ? real_of(run_.slots[Slot::Blocked]) : 0;
    return lost / all;
}

bool WaitingCauses::is_memory_busiest() const {
    return is_memory_busy() &&
           std::all_of(run_.stages.begin(), run_.stages.end(), [this](const StageUse& stage) {
               return in_window(stage) < memory_in_window();
           });
}

std::string limiting_stage(const AcceleratorResult& result) {
    const WaitingCauses causes(result);
    if (causes.lost_for_memory().value_or(0) > kMemoryBound ||
        (!result.stages.empty() && causes.is_memory_busiest())) {
        return "memory";
    }
    const auto busiest =
        std::max_element(result.stages.begin(), result.stages.end(),
                         [](const StageUse& a, const StageUse& b) { return a.busy < b.busy; });
    return busiest == result.stages.end() ? "" : busiest->name;
}

} // namespace degs
