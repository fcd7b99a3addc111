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
/// called once per process, because SystemC elaborates once. Frames are taken from `frames` as they
/// are needed, and let go when they have ended. All workloads must have the tile size and tile mode
/// that the accelerator asks for. Each `views` of them are one frame of that many views; their
/// number divides that of the workloads. Images that are not recorded are empty. Throws
/// std::logic_error if the model is broken, and what the source throws.
AcceleratorResult run_accelerator(const AcceleratorConfig& config, FrameSource frames,
                                  Fidelity fidelity, const BuildOptions& options,
                                  const Recording& recording, Progress& progress, int views = 1);

/// Measures a simulation from its construction on.
class SimulationClock {
public:
    /// Sets sim_s, without the waits for the functional model, and functional_s.
    void stop(AcceleratorResult& result) const {
        result.sim_s = own_.seconds() - other_own_s_;
        result.functional_s = std::max(0.0, all_.seconds() - other_s_ - result.sim_s);
    }
    /// Does `work`, which is no simulation, and leaves out the time that all threads spend on it.
    template <class Work>
    auto leave_out(const Work& work) {
        const CpuStopwatch all, own = CpuStopwatch::of_this_thread();
        auto made = work();
        other_s_ += all.seconds();
        other_own_s_ += own.seconds();
        return made;
    }

private:
    double other_s_ = 0, other_own_s_ = 0;
    CpuStopwatch all_;
    CpuStopwatch own_ = CpuStopwatch::of_this_thread();
};

/// Throws std::logic_error unless all tiles are done (else the model is deadlocked), every
/// invariant holds and the slots fill PEs x window.
void check_result(const AcceleratorResult& result);

} // namespace degs::sim
