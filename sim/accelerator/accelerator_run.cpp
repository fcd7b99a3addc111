// SPDX-License-Identifier: Apache-2.0
#include "sim/accelerator/accelerator_run.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/ratio.hpp"
#include "modules/kit/accelerator/accelerator_energy.hpp"

namespace degs::sim {
namespace {

/// Simulated time between two looks at the progress; some 10 ms of host time.
constexpr Cycle kCyclesPerSlice = 10000;

/// sc_start(t) executes the same events in the same order as sc_start(), so that looking
/// in between changes nothing. Frames that have not been made yet count as those that have.
void run_kernel(const RenderEngine& engine, const ClockDomain& clock, const RenderJob& job,
                Progress& progress) {
    do {
        sc_core::sc_start(clock.at(kCyclesPerSlice));
        const std::size_t frames = job.frames.size();
        progress.done(ratio_of(engine.finished_tiles(), job.tiles.size()) *
                      ratio_of(frames, frames + job.source.frames));
    } while (sc_core::sc_pending_activity());
}

/// The frames of a run, and what is known of them when they have been let go.
class RunFrames {
public:
    RunFrames(RenderJob& job, FrameSource frames, SimulationClock& clock)
        : job_(job), frames_(std::move(frames)), clock_(clock) {
        job_.source = {frames_.frames, [this] { return take(); }};
    }

    /// Is called when the kernel has stopped; throws what the source has thrown.
    void end() {
        if (failure_ != nullptr) {
            std::rethrow_exception(failure_);
        }
        while (job_.add_next()) { // of a model that is deadlocked
        }
        note_tiles();
    }
    std::uint64_t pixels() const { return pixels_; }
    /// Tiles as they lie in the images, if they are recorded.
    std::vector<TileRecord>& tiles() { return tiles_; }

private:
    // Keeps an exception for end(), because the kernel would turn it into an error of its own.
    FramePointer take() {
        note_tiles();
        FramePointer frame;
        try {
            frame = clock_.leave_out([this] { return frames_.take(); });
        } catch (...) {
            failure_ = std::current_exception();
        }
        if (frame != nullptr) {
            pixels_ += frame->grid().shown_pixels();
        }
        return frame;
    }
    /// Before those retire that have not been noted: see RenderJob::add_next().
    void note_tiles() {
        while (job_.recorder != nullptr && tiles_.size() < job_.tiles.size()) {
            const JobTile& tile = job_.tiles[tiles_.size()];
            tiles_.push_back({tile.frame, tile.x, tile.y, tile.image_columns().size(),
                              tile.image_rows().size(), tile.count, TileActivity()});
        }
    }

    RenderJob& job_;
    FrameSource frames_;
    SimulationClock& clock_;
    std::uint64_t pixels_ = 0;
    std::vector<TileRecord> tiles_;
    std::exception_ptr failure_;
};

void collect_recording(AcceleratorResult& result, RenderJob& job, std::vector<TileRecord>& tiles,
                       Timeline* timeline) {
    job.recorder->close();
    const std::vector<TileActivity>& activity = job.recorder->tiles();
    for (std::size_t t = 0; t < std::min(tiles.size(), activity.size()); ++t) {
        tiles[t].activity = activity[t];
    }
    result.tile_records = std::move(tiles);
    if (timeline != nullptr) {
        result.timeline = timeline->record(std::max(result.cycles, result.memory_window));
    }
}

/// Adds the FIFOs below a module whose cells neither a buffer of the results nor the costs of a
/// unit stand for.
void collect_unbilled(std::vector<std::string>& unbilled, const sc_core::sc_object& module) {
    for (const sc_core::sc_object* child : module.get_child_objects()) {
        const auto* fifo = dynamic_cast<const FifoBase*>(child);
        if (fifo != nullptr && !fifo->is_billed()) {
            unbilled.push_back(std::string(fifo->fifo_name()) + " of " +
                               std::to_string(fifo->depth()) + " cells");
        }
        collect_unbilled(unbilled, *child);
    }
}

void require_equal(const std::string& law, std::uint64_t left, std::uint64_t right) {
    if (left != right) {
        throw std::logic_error("the model is broken, " + law + ": " + std::to_string(left) +
                               " is not " + std::to_string(right));
    }
}

} // namespace

AcceleratorResult run_accelerator(const AcceleratorConfig& config, FrameSource frames,
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
    RenderJob job = make_render_job(config, views);
    job.drawn_images = recording.images ? frames.frames : views;
    SimulationClock run;
    RunFrames taken(job, std::move(frames), run);
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
    run = SimulationClock();
    run_kernel(*engine, time.clock, job, progress);
    run.stop(result);
    taken.end();
    result.activations = activations;

    result.name = config.name;
    result.pes = config.pes();
    result.clock_ghz = config.clock_ghz;
    result.array_only = options.array_only;
    result.tiles_listed = job.tiles.size();
    result.stopped = time.clock.ceil(sc_core::sc_time_stamp());
    engine->collect(result);
    collect_unbilled(result.unbilled, *engine);
    if (views > 1) {
        group_views(result, views);
    }
    result.sim_s += result.waited_s;
    result.energy = energy_of(config, result, taken.pixels());
    if (job.recorder != nullptr) {
        collect_recording(result, job, taken.tiles(), timeline ? &*timeline : nullptr);
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
    if (!result.unbilled.empty()) {
        throw std::logic_error("the model is incomplete, no buffer of its results stands for " +
                               result.unbilled.front() +
                               "; use_of() and add_buffer() list it, and set_billed() says that "
                               "the costs of a unit include it");
    }
    for (const Conservation& c : result.conservation) {
        require_equal(c.law, c.left, c.right);
    }
    require_equal("the slots must fill PEs x window", result.slots.total(),
                  result.pes * result.window.cycles());
}

} // namespace degs::sim
