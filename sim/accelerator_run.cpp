// SPDX-License-Identifier: Apache-2.0
#include "sim/accelerator_run.hpp"

#include <algorithm>
#include <stdexcept>

#include "sim/degs_run.hpp"

namespace degs::sim {
namespace {

void require_equal(const std::string& law, std::uint64_t left, std::uint64_t right) {
    if (left != right) {
        throw std::logic_error("the model is broken, " + law + ": " + std::to_string(left) +
                               " is not " + std::to_string(right));
    }
}

} // namespace

AcceleratorResult run_accelerator(const RunConfig& config, const FrameWorkload& workload,
                                  Fidelity fidelity, Progress& progress) {
    AcceleratorResult result;
    switch (config.accelerator) {
    case AcceleratorKind::Degs:
        result = run_degs(config.degs, workload, fidelity, progress);
        break;
    }
    check_result(result);
    return result;
}

void check_result(const AcceleratorResult& result) {
    if (result.tiles != result.tiles_listed) {
        throw std::logic_error("the model is deadlocked, nothing is left to happen at cycle " +
                               std::to_string(result.stopped) + " and " +
                               std::to_string(result.tiles) + " of " +
                               std::to_string(result.tiles_listed) + " tiles are finished");
    }
    for (const Conservation& c : result.conservation) {
        require_equal(c.law, c.left, c.right);
    }
    require_equal("the slots must fill PEs x window", result.slots.total(),
                  static_cast<std::uint64_t>(result.pes) * result.window.cycles());
}

std::string limiting_stage(const AcceleratorResult& result) {
    const auto busiest =
        std::max_element(result.stages.begin(), result.stages.end(),
                         [](const StageUse& a, const StageUse& b) { return a.busy < b.busy; });
    if (busiest == result.stages.end() || result.memory_utilization > busiest->busy) {
        return "memory";
    }
    return busiest->name;
}

} // namespace degs::sim
