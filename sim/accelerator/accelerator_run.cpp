// SPDX-License-Identifier: Apache-2.0
#include "sim/accelerator/accelerator_run.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "base/ratio.hpp"
#include "modules/kit/accelerator/accelerator_energy.hpp"

namespace degs::sim {
namespace {

/// Simulated time between two looks at the progress; some 10 ms of host time.
constexpr Cycle kCyclesPerSlice = 10000;

/// sc_start(t) executes the same events in the same order as sc_start(), so that looking
/// in between changes nothing.
void run_kernel(const RenderEngine& engine, const ClockDomain& clock, std::size_t tiles,
                Progress& progress) {
    do {
        sc_core::sc_start(clock.at(kCyclesPerSlice));
        progress.done(ratio_of(engine.finished_tiles(), tiles));
    } while (sc_core::sc_pending_activity());
}

/// Tiles as they lie in the images, for those who no longer have the job.
void collect_recording(AcceleratorResult& result, RenderJob& job, Timeline* timeline) {
    job.recorder->close();
    const std::vector<TileActivity>& activity = job.recorder->tiles();
    for (std::size_t t = 0; t < job.tiles.size(); ++t) {
        const JobTile& tile = job.tiles[t];
        result.tile_records.push_back({tile.frame, tile.x, tile.y, tile.drawn_columns().size(),
                                       tile.drawn_rows().size(), tile.count,
                                       t < activity.size() ? activity[t] : TileActivity()});
    }
    if (timeline != nullptr) {
        result.timeline = timeline->record(std::max(result.cycles, result.memory_window));
    }
}

std::uint64_t pixels_of(const std::vector<const FrameWorkload*>& frames) {
    std::uint64_t pixels = 0;
    for (const FrameWorkload* frame : frames) {
        pixels += frame->grid().shown_pixels();
    }
    return pixels;
}

void require_equal(const std::string& law, std::uint64_t left, std::uint64_t right) {
    if (left != right) {
        throw std::logic_error("the model is broken, " + law + ": " + std::to_string(left) +
                               " is not " + std::to_string(right));
    }
}

} // namespace

AcceleratorResult run_accelerator(const AcceleratorConfig& config,
                                  const std::vector<const FrameWorkload*>& frames,
                                  Fidelity fidelity, const BuildOptions& options,
                                  const Recording& recording, Progress& progress, int views) {
    const Stopwatch elaborate;
    std::optional<Timeline> timeline;
    if (recording.timeline) {
        timeline.emplace(*recording.timeline);
    }
    std::uint64_t activations = 0;
    const Timebase time{ClockDomain(config.clock_ghz), fidelity, timeline ? &*timeline : nullptr,
                        &activations};
    RenderJob job = make_render_job({frames.begin(), frames.begin() + views}, config, views);
    job.keeps_images = recording.images;
    std::for_each(frames.begin() + views, frames.end(),
                  [&job](const FrameWorkload* frame) { job.add(*frame); });
    if (timeline || recording.tiles) {
        job.recorder = std::make_unique<SlotRecorder>(time.timeline);
    }
    const std::unique_ptr<RenderEngine> engine = config.build("accelerator", time, job, options);
    if (recording.log != nullptr) {
        logged_block(*engine, config.name, recording.block).log_to(*recording.log);
    }
    AcceleratorResult result;
    result.elaborate_s = elaborate.seconds();

    result.sim_start = std::chrono::steady_clock::now();
    const SimulationClock run;
    run_kernel(*engine, time.clock, job.tiles.size(), progress);
    run.stop(result);
    result.activations = activations;

    result.name = config.name;
    result.pes = config.pes();
    result.clock_ghz = config.clock_ghz;
    result.array_only = options.array_only;
    result.tiles_listed = job.tiles.size();
    result.stopped = time.clock.ceil(sc_core::sc_time_stamp());
    engine->collect(result);
    if (views > 1) {
        group_views(result, views);
    }
    result.sim_s += result.waited_s;
    result.energy = energy_of(config, result, pixels_of(frames));
    if (job.recorder != nullptr) {
        collect_recording(result, job, timeline ? &*timeline : nullptr);
    }
    result.images.assign(std::make_move_iterator(job.images.begin()),
                         std::make_move_iterator(job.images.end()));
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
                  result.pes * result.window.cycles());
}

} // namespace degs::sim
