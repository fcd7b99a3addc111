// SPDX-License-Identifier: Apache-2.0
#include "sim/degs_run.hpp"

#include "sim/stopwatch.hpp"

namespace degs::sim {
namespace {

/// Simulated time between two looks at the progress; some 10 ms of host time.
constexpr Cycle kCyclesPerSlice = 10000;

/// sc_start(t) executes the same events in the same order as sc_start(), so that looking in between
/// changes nothing.
void run_kernel(const Degs& degs, const ClockDomain& clock, std::size_t tiles, Progress& progress) {
    do {
        sc_core::sc_start(clock.at(kCyclesPerSlice));
        const auto done = static_cast<double>(finished_tiles(degs));
        progress.done(tiles == 0 ? 0.0 : done / static_cast<double>(tiles));
    } while (sc_core::sc_pending_activity());
}

} // namespace

AcceleratorResult run_degs(const DegsConfig& config, const FrameWorkload& workload,
                           Fidelity fidelity, Progress& progress) {
    const Stopwatch elaborate;
    const DataPathOptions path{config.pipeline.numbers, config.pipeline.span_ends,
                               config.pipeline.span_delta, config.pipeline.stop_rule};
    const Timebase time{ClockDomain(config.clock_ghz), fidelity};
    RenderJob job = make_render_job({&workload}, path, config.contexts());
    const Degs degs("degs", config, time, job);
    AcceleratorResult result;
    result.elaborate_s = elaborate.seconds();

    const Stopwatch run;
    run_kernel(degs, time.clock, job.tiles.size(), progress);
    result.sim_s = run.seconds();

    result.tiles_listed = job.tiles.size();
    result.stopped = time.clock.ceil(sc_core::sc_time_stamp());
    collect_degs(degs, result);
    result.image = std::move(job.images[0]);
    return result;
}

} // namespace degs::sim
