// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "modules/kit/accelerator/render_engine.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/text/progress.hpp"

namespace degs::sim {

/// What a run records besides its sums. Results do not depend on it.
struct Recording {
    std::optional<Timeline::Config> timeline;
    bool tiles = false;  ///< what the array did for each tile
    bool images = false; ///< of all frames; else the first one's, and the others take no memory
    std::string block;   ///< that writes `log`, see logged_block(); empty: none
    EventLog* log = nullptr;
};

/// Builds the accelerator, renders the frames one after the other and checks the invariants. May be
/// called once per process, because SystemC elaborates once. All workloads must have the tile size
/// and tile mode that the accelerator asks for. Each `views` of them are one frame of that many
/// views; their number divides that of the workloads. Images that are not recorded are empty.
/// Throws std::logic_error if the model is broken.
AcceleratorResult run_accelerator(const AcceleratorConfig& config,
                                  const std::vector<const FrameWorkload*>& frames,
                                  Fidelity fidelity, const BuildOptions& options,
                                  const Recording& recording, Progress& progress, int views = 1);

/// Measures a simulation from its construction on.
class SimulationClock {
public:
    /// Sets sim_s, without the waits for the drawing, and drawing_s.
    void stop(AcceleratorResult& result) const {
        result.sim_s = own_.seconds();
        result.drawing_s = std::max(0.0, all_.seconds() - result.sim_s);
    }

private:
    CpuStopwatch all_;
    CpuStopwatch own_ = CpuStopwatch::of_this_thread();
};

/// Throws std::logic_error unless all tiles are done (else the model is deadlocked), every
/// invariant holds and the slots fill PEs x window.
void check_result(const AcceleratorResult& result);

} // namespace degs::sim
