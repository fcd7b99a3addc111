// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/engine/tiled_accelerator.hpp"

#include "modules/kit/memory/stream_kinds.hpp"

namespace degs {

TiledAccelerator::TiledAccelerator(const sc_core::sc_module_name& name, const Parts& parts,
                                   const Timebase& time, RenderJob& job,
                                   const BuildOptions& options)
    : RenderEngine(name), parts_(parts), time_(time), job_(job), options_(options),
      next_uses_(job) {
    parts_.front.instant = options_.array_only;
    if (parts_.granted) {
        build_engines();
    } else {
        build_streams();
    }
    frame_ends_.build(parts_.frame_end, time_, parts_.front.traffic, job_, pixel_buffers_,
                      {front_end_->frame_free, front_end_->listed}, 1, options_);
    build_memory();
}

// One engine for all tiles: one that is cancelled is neither fetched nor sorted any further.
void TiledAccelerator::build_streams() {
    front_end_ = std::make_unique<TileFrontEnd>("front_end", parts_.front, time_, job_);
    const std::size_t fetchers = front_end_->sorted.size();
    build_monitor(0, fetchers + front_end_->cancel.size());
    for (std::size_t i = 0; i < fetchers; ++i) {
        build_fetcher(nullptr);
        auto& lists = add_ring(sorted_rings_, "sorted", time_, 1, 1);
        front_end_->sorted[i].bind(lists);
        fetchers_[i]->sorted.bind(lists);
        bind_cancel(0, i, fetchers_[i]->cancel);
        fetchers_[i]->out[0].bind(
            add_ring(splat_rings_, parts_.splat_rings, time_, parts_.splat_chunks, 1));
    }
    for (std::size_t i = 0; i < front_end_->cancel.size(); ++i) {
        bind_cancel(0, fetchers + i, front_end_->cancel[i]);
    }
    build_pixel_buffer(0);
}

// Granted lists have been sorted to their end, so that the sorters wait for cancellations that
// never come.
void TiledAccelerator::build_engines() {
    nobody_ = std::make_unique<Process>(time_);
    nobody_->finish();
    front_end_ = std::make_unique<TileFrontEnd>("front_end", parts_.front, time_, job_);
    for (auto& listener : front_end_->cancel) {
        auto& never = add_ring(cancel_rings_, "cancel", time_, 1, 1);
        never.connect_writer(*nobody_);
        listener.bind(never);
    }
    build_caches();
    for (int e = 0; e < parts_.engines; ++e) {
        const std::size_t index = e;
        build_fetcher(caches_.empty() ? nullptr : caches_[index].get());
        fetchers_[index]->out[0].bind(
            add_ring(splat_rings_, parts_.splat_rings, time_, parts_.splat_chunks, 1));
        build_monitor(e, 1);
        bind_cancel(e, 0, fetchers_[index]->cancel);
        build_pixel_buffer(e);
    }
    grants_ =
        std::make_unique<TileGrants>(*front_end_, fetchers_, parts_.grant_cycles, time_, job_);
}

// Without memory time nothing depends on what is cached.
void TiledAccelerator::build_caches() {
    if (parts_.cache_records == 0 || options_.array_only) {
        return;
    }
    for (int e = 0; e < parts_.engines; ++e) {
        caches_.push_back(std::make_unique<ReuseCache>(job_, next_uses_, parts_.cache_records));
    }
}

void TiledAccelerator::build_fetcher(ReuseCache* cache) {
    fetchers_.push_back(std::make_unique<SplatFetcher>(
        numbered("fetcher", fetchers_.size()).c_str(), parts_.fetching, parts_.front.traffic, time_,
        job_, 1, options_.array_only, parts_.granted, cache));
}

void TiledAccelerator::build_monitor(int engine, std::size_t listeners) {
    monitors_.push_back(std::make_unique<TileMonitor>(name_of("monitor", engine).c_str(),
                                                      parts_.monitor, time_, job_, 1, listeners,
                                                      parts_.granted));
    monitors_.back()->in[0].bind(add_wire(state_rings_, "tile_state", time_, 1));
}

void TiledAccelerator::bind_cancel(int engine, std::size_t listener, FifoPort<TileNumber>& port) {
    auto& cancel = add_wire(cancel_rings_, "cancel", time_, parts_.monitor.latency_cycles);
    monitors_[engine]->out[listener].bind(cancel);
    port.bind(cancel);
}

void TiledAccelerator::build_pixel_buffer(int engine) {
    PixelBuffer::Share share;
    share.first_context = first_context(engine);
    share.granted = parts_.granted;
    pixel_buffers_.push_back(std::make_unique<PixelBuffer>(
        name_of("pixel_buffer", engine).c_str(), parts_.pixel_buffer, parts_.front.traffic, time_,
        job_, 1, parts_.contexts, share, FrameEnds::awaited(front_end_->frame_free, options_),
        options_.array_only));
    PixelBuffer& pixels = *pixel_buffers_.back();
    pixels.in[0].bind(add_wire(done_rings_, "tile_done", time_, parts_.writeback_cycles));
    pixels.context_free[0].bind(
        add_wire(context_rings_, "context_free", time_, parts_.pixel_buffer.free_cycles));
}

void TiledAccelerator::build_memory() {
    front_end_->connect_memory(streams_, fetchers_);
    for (auto& unit : pixel_buffers_) {
        streams_.connect(unit->frame_buffer, stream_kinds::kFrameBuffer);
    }
    frame_ends_.connect_memory(streams_);
    streams_.build("memory", parts_.memory, time_, options_);
}

std::size_t TiledAccelerator::finished_tiles() const {
    return sum_of(pixel_buffers_, &PixelBuffer::Stats::tiles);
}

std::uint64_t TiledAccelerator::list_entries() const {
    return job_.tiles.entries();
}

void TiledAccelerator::collect(AcceleratorResult& result) const {
    collect_frames(result, job_, pixel_buffers_, frame_ends_.background());
    result.tiles = finished_tiles();
    result.tiles_cancelled = sum_of(monitors_, &TileMonitor::Stats::tiles_cancelled);
    front_end_->collect(result);
    if (grants_) {
        const TileDispatcher::Stats& dispatched = dispatcher().stats();
        add_stage(result, {"dispatch", "The Tile Dispatcher, a cycle for each tile."}, 1,
                  dispatched.tiles, counters_of(dispatched));
    }
    add_stage(result, kFetching, fetchers_.size(), sum_of(fetchers_, &SplatFetcher::Stats::busy),
              Counters().add(fetchers_));
    result.waits.splats = ratio_of(splat_buffer().late_cycles, parts_.engines);
    streams_.collect(result);
    explain_tiles(result, records_cancelled());
    collect_engines(result);
}

} // namespace degs
