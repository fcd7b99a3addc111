// SPDX-License-Identifier: Apache-2.0
#include "baselines/gscore.hpp"

#include "tlm/grouped_number.hpp"

namespace degs {
namespace {

// Feedback and tokens are wires, not buffers: deep enough never to push back.
constexpr int kTokenDepth = 64;

} // namespace

Gscore::Gscore(const sc_core::sc_module_name& name, const GscoreConfig& config,
               const Timebase& time, RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), config_(config), time_(time), job_(job), options_(options) {
    build_front_end();
    build_array();
    build_frame_gate();
    build_memory();
}

std::unique_ptr<RenderEngine> GscoreConfig::build(const char* module, const Timebase& time,
                                                  RenderJob& job,
                                                  const BuildOptions& options) const {
    return std::make_unique<Gscore>(module, *this, time, job, options);
}

void Gscore::build_front_end() {
    TileFrontEnd::Config front;
    front.projection = config_.projection;
    front.binning = config_.binning;
    front.hierarchical = config_.sorting;
    front.on_demand = true;
    front.traffic = config_.traffic;
    front.sort_capacity = static_cast<std::uint64_t>(config_.sort_capacity());
    front.frames_in_flight = config_.frames_in_flight;
    front.instant = options_.array_only;
    front_end_ = std::make_unique<TileFrontEnd>("front_end", front, time_, job_);
    const std::size_t fetchers = front_end_->sorted.size();
    monitor_ = std::make_unique<TileMonitor>("monitor", config_.monitor, time_, job_, 1,
                                             fetchers + front_end_->cancel.size());
    const auto cancel_ring = [this](std::size_t listener) -> DatedFifo<TileNumber>& {
        auto& cancel =
            add_ring(cancel_rings_, "cancel", time_, kTokenDepth, config_.monitor.latency_cycles);
        monitor_->out[listener].bind(cancel);
        return cancel;
    };
    for (std::size_t i = 0; i < fetchers; ++i) {
        fetchers_.push_back(std::make_unique<SplatFetcher>(numbered("fetcher", i).c_str(),
                                                           config_.fetching, config_.traffic, time_,
                                                           job_, 1, options_.array_only));
        auto& lists = add_ring(sorted_rings_, "sorted", time_, 1, 1);
        front_end_->sorted[i].bind(lists);
        fetchers_[i]->sorted.bind(lists);
        fetchers_[i]->cancel.bind(cancel_ring(i));
    }
    for (std::size_t i = 0; i < front_end_->cancel.size(); ++i) {
        front_end_->cancel[i].bind(cancel_ring(fetchers + i));
    }
}

void Gscore::build_array() {
    const int contexts = config_.tile_contexts();
    const int tokens = kTokenDepth + contexts;
    pixel_buffers_.push_back(std::make_unique<PixelBuffer>(
        "pixel_buffer", config_.pixel_buffer, config_.traffic, time_, job_, 1, contexts,
        PixelBuffer::Share{}, front_end_->frame_free.size() != 0, options_.array_only));
    PixelBuffer& pixels = *pixel_buffers_.front();
    array_ = std::make_unique<LockstepArray>("array", config_.array, time_, job_, fetchers_.size(),
                                             contexts);
    for (std::size_t i = 0; i < fetchers_.size(); ++i) {
        auto& splats = add_ring(splat_rings_, "splats", time_, config_.splat_chunks(), 1);
        fetchers_[i]->out[0].bind(splats);
        array_->in[i].bind(splats);
    }
    auto& done = add_ring(done_rings_, "tile_done", time_, tokens, config_.array.pipeline_cycles);
    array_->tile_done.bind(done);
    pixels.in[0].bind(done);
    auto& state = add_ring(state_rings_, "tile_state", time_, tokens, 1);
    array_->tile_state.bind(state);
    monitor_->in[0].bind(state);
    auto& free = add_ring(context_rings_, "context_free", time_, tokens, 1);
    pixels.context_free[0].bind(free);
    array_->context_free.bind(free);
}

// Frames wait for each other only in runs of more frames than may be in flight.
void Gscore::build_frame_gate() {
    auto& listeners = front_end_->frame_free;
    if (listeners.size() == 0) {
        return;
    }
    frame_gate_ = std::make_unique<FrameGate>("frame_gate", time_, job_, 1, listeners.size(), 1);
    auto& done = add_ring(frame_rings_, "frame_done", time_, kTokenDepth, 1);
    pixel_buffers_.front()->frame_done[0].bind(done);
    frame_gate_->in[0].bind(done);
    for (std::size_t i = 0; i < listeners.size(); ++i) {
        auto& free = add_ring(frame_rings_, "frame_free", time_, kTokenDepth, 1);
        frame_gate_->out[i].bind(free);
        listeners[i].bind(free);
    }
}

void Gscore::build_memory() {
    front_end_->connect_memory(streams_, fetchers_);
    streams_.connect(pixel_buffers_.front()->frame_buffer, "frame_buffer");
    streams_.build("memory", config_.memory, time_, options_.array_only);
}

std::size_t Gscore::finished_tiles() const {
    return pixel_buffers_.front()->stats().tiles;
}

void Gscore::collect_stages(AcceleratorResult& result) const {
    front_end_->collect(result);
    using F = SplatFetcher::Stats;
    add_stage(result, "fetching", fetchers_.size(), sum_of(fetchers_, &F::busy),
              {{"records", sum_of(fetchers_, &F::records)},
               {"records_cancelled", sum_of(fetchers_, &F::records_cancelled)}});
    const LockstepArray::Stats& array = array_->stats();
    add_stage(result, "blending", static_cast<std::size_t>(config_.array.clusters),
              array.passes * static_cast<std::uint64_t>(config_.array.clusters),
              {{"passes", array.passes},
               {"splats", array.splats},
               {"splats_skipped", array.splats_skipped},
               {"splats_discarded", array.splats_discarded},
               {"tiles_stopped", array.tiles_stopped},
               {"pixels_ended", array.pixels_ended}});
    add_buffer(result, "gaussian_buffer", config_.buffer.bytes - config_.pixel_buffer.bytes,
               config_.splat_chunks(), use_of(splat_rings_));
    add_pixel_buffer(result, config_.pixel_buffer.bytes, config_.tile_contexts(), pixel_buffers_);
}

void Gscore::collect_laws(AcceleratorResult& result) const {
    using F = SplatFetcher::Stats;
    const LockstepArray::Stats& array = array_->stats();
    const SlotAccount& s = result.slots;
    std::uint64_t pairs = 0;
    for (const JobTile& tile : job_.tiles) {
        pairs += tile.count;
    }
    const std::uint64_t fetched = sum_of(fetchers_, &F::records);
    result.conservation = {
        {"list entries = records fetched + cancelled", pairs,
         fetched + sum_of(fetchers_, &F::records_cancelled)},
        {"records fetched = splats worked on + discarded", fetched,
         array.splats + array.splats_discarded},
        {"lanes x passes = lanes evaluated",
         array.passes * static_cast<std::uint64_t>(config_.array.lanes),
         s.useful + s.boundary + s.terminated},
    };
    if (!front_end_->hierarchical().empty()) {
        using H = HierarchicalSorter::Stats;
        const auto& sorters = front_end_->hierarchical();
        result.conservation.push_back(
            {"list entries = keys sorted + cancelled", pairs,
             sum_of(sorters, &H::keys_sorted) + sum_of(sorters, &H::keys_cancelled)});
    }
}

void Gscore::explain(AcceleratorResult& result) const {
    auto& out = result.left_out;
    explain_tiles(result, sum_of(fetchers_, &SplatFetcher::Stats::records_cancelled));
    out.push_back(grouped(array_->stats().splats_skipped) +
                  " splats took no slot: their sub-tiles had ended, or their box meets none.");
    out.push_back(grouped(array_->stats().splats_discarded) +
                  " splats had been fetched when their tile stopped.");
}

void Gscore::collect(AcceleratorResult& result) const {
    collect_frames(result, pixel_buffers_);
    result.tiles = finished_tiles();
    result.tiles_cancelled = monitor_->stats().tiles_cancelled;
    result.slots = array_->stats().slots;
    result.window = array_->stats().window;
    collect_stages(result);
    streams_.collect(result);
    collect_laws(result);
    explain(result);
}

} // namespace degs
