// SPDX-License-Identifier: Apache-2.0
#include "modules/array/tile_array_engine.hpp"
#include "modules/stream_kinds.hpp"

namespace degs {

TileArrayEngine::TileArrayEngine(const sc_core::sc_module_name& name, const Parts& parts,
                                 const Timebase& time, RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), parts_(parts), job_(job), options_(options) {
    parts_.front.instant = options_.array_only;
    build_front_end(time);
    build_pixels(time);
    frame_ends_.build(parts_.frame_end, time, parts_.front.traffic, job_, pixel_buffers_,
                      {front_end_->frame_free, front_end_->listed}, 1, options_);
    front_end_->connect_memory(streams_, fetchers_);
    streams_.connect(pixel_buffers_.front()->frame_buffer, stream_kinds::kFrameBuffer);
    frame_ends_.connect_memory(streams_);
    streams_.build("memory", parts_.memory, time, options_);
}

void TileArrayEngine::build_front_end(const Timebase& time) {
    front_end_ = std::make_unique<TileFrontEnd>("front_end", parts_.front, time, job_);
    const std::size_t fetchers = front_end_->sorted.size();
    monitor_ = std::make_unique<TileMonitor>("monitor", parts_.monitor, time, job_, 1,
                                             fetchers + front_end_->cancel.size());
    const auto cancel_ring = [&](std::size_t listener) -> DatedFifo<TileNumber>& {
        auto& cancel = add_wire(cancel_rings_, "cancel", time, parts_.monitor.latency_cycles);
        monitor_->out[listener].bind(cancel);
        return cancel;
    };
    for (std::size_t i = 0; i < fetchers; ++i) {
        fetchers_.push_back(std::make_unique<SplatFetcher>(numbered("fetcher", i).c_str(),
                                                           parts_.fetching, parts_.front.traffic,
                                                           time, job_, 1, options_.array_only));
        auto& lists = add_ring(sorted_rings_, "sorted", time, 1, 1);
        front_end_->sorted[i].bind(lists);
        fetchers_[i]->sorted.bind(lists);
        fetchers_[i]->cancel.bind(cancel_ring(i));
        fetchers_[i]->out[0].bind(add_ring(splat_rings_, "splats", time, parts_.splat_chunks, 1));
    }
    for (std::size_t i = 0; i < front_end_->cancel.size(); ++i) {
        front_end_->cancel[i].bind(cancel_ring(fetchers + i));
    }
}

void TileArrayEngine::build_pixels(const Timebase& time) {
    pixel_buffers_.push_back(std::make_unique<PixelBuffer>(
        "pixel_buffer", parts_.pixel_buffer, parts_.front.traffic, time, job_, 1, parts_.contexts,
        PixelBuffer::Share{}, FrameEnds::awaited(front_end_->frame_free, options_),
        options_.array_only));
    PixelBuffer& pixels = *pixel_buffers_.front();
    pixels.in[0].bind(add_wire(report_rings_, "tile_done", time, parts_.writeback_cycles));
    monitor_->in[0].bind(add_wire(report_rings_, "tile_state", time, 1));
    pixels.context_free[0].bind(add_wire(context_rings_, "context_free", time, 1));
}

std::size_t TileArrayEngine::finished_tiles() const {
    return pixel_buffers_.front()->stats().tiles;
}

std::uint64_t TileArrayEngine::list_entries() const {
    std::uint64_t entries = 0;
    for (const JobTile& tile : job_.tiles) {
        entries += tile.count;
    }
    return entries;
}

void TileArrayEngine::collect(AcceleratorResult& result) const {
    collect_frames(result, pixel_buffers_, frame_ends_.background());
    result.tiles = finished_tiles();
    result.tiles_cancelled = monitor_->stats().tiles_cancelled;
    front_end_->collect(result);
    using F = SplatFetcher::Stats;
    add_stage(result, kFetching, fetchers_.size(), sum_of(fetchers_, &F::busy),
              Counters().add(fetchers_));
    add_buffer(result, {"gaussian_buffer", "Chunks of splats on their way to the array."},
               parts_.buffer_bytes, parts_.splat_chunks, use_of(splat_rings_));
    add_pixel_buffer(result, parts_.pixel_buffer.bytes, parts_.contexts, pixel_buffers_);
    streams_.collect(result);
    explain_tiles(result, sum_of(fetchers_, &F::records_cancelled));
    result.conservation.push_back({"list entries = records fetched + cancelled", list_entries(),
                                   records_fetched() + sum_of(fetchers_, &F::records_cancelled)});
    collect_array(result);
    add_activity(result, "gaussian_buffer",
                 rate_of(2 * records_fetched(), 1) * parts_.front.traffic.splat_bytes +
                     rate_of(front_end_->keys_moved(), 1) * parts_.front.traffic.list_entry_bytes);
    add_pixel_activity(result, job_, parts_.pixel_bytes);
}

} // namespace degs
