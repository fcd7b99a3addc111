// SPDX-License-Identifier: Apache-2.0
#include "modules/array/tile_engine_array.hpp"

#include <algorithm>

#include "modules/stream_kinds.hpp"

namespace degs {

TileEngineArray::TileEngineArray(const sc_core::sc_module_name& name, const Parts& parts,
                                 const Timebase& time, RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), parts_(parts), time_(time), job_(job), options_(options), nobody_(time),
      next_uses_(job) {
    nobody_.finish();
    parts_.front.instant = options_.array_only;
    build_front_end();
    build_caches();
    for (int e = 0; e < parts_.engines; ++e) {
        build_fetcher(e);
        build_pixel_buffer(e);
    }
    grants_ = std::make_unique<TileGrants>(*front_end_, fetchers_, time_, job_);
    frame_ends_.build(parts_.frame_end, time_, parts_.front.traffic, job_, pixel_buffers_,
                      {front_end_->frame_free, front_end_->listed}, 1, options_);
    build_memory();
}

void TileEngineArray::build_front_end() {
    front_end_ = std::make_unique<TileFrontEnd>("front_end", parts_.front, time_, job_);
    for (auto& listener : front_end_->cancel) {
        auto& never = add_ring(cancel_rings_, "cancel", time_, 1, 1);
        never.connect_writer(nobody_);
        listener.bind(never);
    }
}

// Without memory time nothing depends on what is cached.
void TileEngineArray::build_caches() {
    if (parts_.cache_records == 0 || options_.array_only) {
        return;
    }
    for (int e = 0; e < parts_.engines; ++e) {
        caches_.push_back(std::make_unique<ReuseCache>(job_, next_uses_, parts_.cache_records));
    }
}

void TileEngineArray::build_fetcher(int index) {
    const std::size_t e = index;
    fetchers_.push_back(std::make_unique<SplatFetcher>(
        numbered("fetcher", e).c_str(), parts_.fetching, parts_.front.traffic, time_, job_, 1,
        options_.array_only, true, caches_.empty() ? nullptr : caches_[e].get()));
    fetchers_[e]->out[0].bind(
        add_ring(splat_rings_, "splat_buffer", time_, parts_.splat_chunks, 1));

    monitors_.push_back(std::make_unique<TileMonitor>(numbered("monitor", e).c_str(),
                                                      parts_.monitor, time_, job_, 1, 1, true));
    monitors_[e]->in[0].bind(add_wire(state_rings_, "tile_state", time_, 1));
    auto& cancel = add_wire(cancel_rings_, "cancel", time_, parts_.monitor.latency_cycles);
    monitors_[e]->out[0].bind(cancel);
    fetchers_[e]->cancel.bind(cancel);
}

void TileEngineArray::build_pixel_buffer(int index) {
    const std::size_t e = index;
    PixelBuffer::Config config = parts_.pixel_buffer;
    config.readout_pixels = std::max(1, config.readout_pixels / parts_.engines);
    PixelBuffer::Share share;
    share.first_context = first_context(index);
    share.granted = true;
    pixel_buffers_.push_back(std::make_unique<PixelBuffer>(
        numbered("pixel_buffer", e).c_str(), config, parts_.front.traffic, time_, job_, 1,
        parts_.contexts, share, FrameEnds::awaited(front_end_->frame_free, options_),
        options_.array_only));
    pixel_buffers_[e]->in[0].bind(
        add_wire(done_rings_, "tile_done", time_, parts_.writeback_cycles));
    pixel_buffers_[e]->context_free[0].bind(add_wire(context_rings_, "context_free", time_, 1));
}

void TileEngineArray::build_memory() {
    front_end_->connect_memory(streams_, fetchers_);
    for (auto& unit : pixel_buffers_) {
        streams_.connect(unit->frame_buffer, stream_kinds::kFrameBuffer);
    }
    frame_ends_.connect_memory(streams_);
    streams_.build("memory", parts_.memory, time_, options_);
}

std::size_t TileEngineArray::finished_tiles() const {
    return sum_of(pixel_buffers_, &PixelBuffer::Stats::tiles);
}

std::uint64_t TileEngineArray::list_entries() const {
    std::uint64_t entries = 0;
    for (const JobTile& tile : job_.tiles) {
        entries += tile.count;
    }
    return entries;
}

void TileEngineArray::add_slots(AcceleratorResult& result, const SlotAccount& slots,
                                const ActiveWindow& window) {
    result.slots += slots;
    result.window.include(window);
}

void TileEngineArray::close_slots(AcceleratorResult& result, const ActiveWindow& window,
                                  std::uint64_t width) {
    if (window.empty()) {
        result.slots.drain += result.window.cycles() * width;
    } else {
        result.slots.starved += (window.first - result.window.first) * width;
        result.slots.drain += (result.window.last - window.last) * width;
    }
}

void TileEngineArray::collect(AcceleratorResult& result) const {
    collect_frames(result, pixel_buffers_, frame_ends_.background());
    result.tiles = finished_tiles();
    result.tiles_cancelled = sum_of(monitors_, &TileMonitor::Stats::tiles_cancelled);
    front_end_->collect(result);
    const TileDispatcher::Stats& dispatched = dispatcher().stats();
    add_stage(result, {"dispatch", "The Tile Dispatcher, a cycle for each tile."}, 1,
              dispatched.tiles, counters_of(dispatched));
    add_stage(result, kFetching, fetchers_.size(), sum_of(fetchers_, &SplatFetcher::Stats::busy),
              Counters().add(fetchers_));
    streams_.collect(result);
    explain_tiles(result, records_cancelled());
    result.conservation.push_back({"splats listed = fetched + cancelled", list_entries(),
                                   records_fetched() + records_cancelled()});
    collect_engines(result);
}

} // namespace degs
