// SPDX-License-Identifier: Apache-2.0
#include "baselines/gbu.hpp"

#include <algorithm>

#include "modules/stream_kinds.hpp"

namespace degs {

Gbu::Gbu(const sc_core::sc_module_name& name, const GbuConfig& config, const Timebase& time,
         RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), config_(config), time_(time), job_(job), options_(options), nobody_(time),
      next_uses_(job) {
    nobody_.finish();
    build_front_end();
    build_caches();
    for (int e = 0; e < config_.engines.count; ++e) {
        build_engine(e);
        build_pixel_buffer(e);
    }
    grants_ = std::make_unique<TileGrants>(*front_end_, fetchers_, time_, job_);
    frame_ends_.build(config_.frame_end, time_, config_.traffic, job_, pixel_buffers_,
                      {front_end_->frame_free, front_end_->listed}, 1, options_);
    build_memory();
}

std::unique_ptr<RenderEngine> GbuConfig::build(const char* module, const Timebase& time,
                                               RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Gbu>(module, *this, time, job, options);
}

void Gbu::build_front_end() {
    TileFrontEnd::Config front;
    front.projection = config_.projection;
    front.binning = config_.binning;
    front.hierarchical = config_.sorting;
    front.on_demand = true;
    front.traffic = config_.traffic;
    front.sort_capacity = config_.sort_capacity();
    front.frames_in_flight = config_.frames_in_flight;
    front.instant = options_.array_only;
    front_end_ = std::make_unique<TileFrontEnd>("front_end", front, time_, job_);
    for (auto& listener : front_end_->cancel) {
        auto& never = ring(cancel_rings_, "cancel", 1, 1);
        never.connect_writer(nobody_);
        listener.bind(never);
    }
}

// Without memory time nothing depends on what is cached.
void Gbu::build_caches() {
    if (config_.reuse_cache.bytes == 0 || options_.array_only) {
        return;
    }
    for (int e = 0; e < config_.engines.count; ++e) {
        caches_.push_back(std::make_unique<ReuseCache>(job_, next_uses_, config_.cache_records()));
    }
}

void Gbu::build_engine(int index) {
    const std::size_t e = index;
    fetchers_.push_back(std::make_unique<SplatFetcher>(
        numbered("fetcher", e).c_str(), config_.fetching, config_.traffic, time_, job_, 1,
        options_.array_only, true, caches_.empty() ? nullptr : caches_[e].get()));
    engines_.push_back(std::make_unique<TileEngine>(numbered("engine", e).c_str(), config_.engines,
                                                    time_, job_, index * config_.contexts(),
                                                    config_.contexts()));
    auto& splats = ring(splat_rings_, "splat_buffer", config_.list_buffer.chunks, 1);
    fetchers_[e]->out[0].bind(splats);
    engines_[e]->in.bind(splats);

    monitors_.push_back(std::make_unique<TileMonitor>(numbered("monitor", e).c_str(),
                                                      config_.monitor, time_, job_, 1, 1, true));
    auto& state = wire(state_rings_, "tile_state", 1);
    engines_[e]->tile_state.bind(state);
    monitors_[e]->in[0].bind(state);
    auto& cancel = wire(cancel_rings_, "cancel", config_.monitor.latency_cycles);
    monitors_[e]->out[0].bind(cancel);
    fetchers_[e]->cancel.bind(cancel);
}

// An engine's share of the Pixel Buffer is read out at its share of the rate.
void Gbu::build_pixel_buffer(int index) {
    const std::size_t e = index;
    PixelBuffer::Config config = config_.pixel_buffer;
    config.readout_pixels = std::max(1, config.readout_pixels / config_.engines.count);
    PixelBuffer::Share share;
    share.first_context = index * config_.contexts();
    share.granted = true;
    pixel_buffers_.push_back(std::make_unique<PixelBuffer>(
        numbered("pixel_buffer", e).c_str(), config, config_.traffic, time_, job_, 1,
        config_.contexts(), share, FrameEnds::awaited(front_end_->frame_free, options_),
        options_.array_only));
    auto& done = wire(done_rings_, "tile_done", 1);
    engines_[e]->tile_done.bind(done);
    pixel_buffers_[e]->in[0].bind(done);
    auto& contexts = wire(context_rings_, "context_free", 1);
    pixel_buffers_[e]->context_free[0].bind(contexts);
    engines_[e]->context_free.bind(contexts);
}

void Gbu::build_memory() {
    front_end_->connect_memory(streams_, fetchers_);
    for (auto& unit : pixel_buffers_) {
        streams_.connect(unit->frame_buffer, stream_kinds::kFrameBuffer);
    }
    frame_ends_.connect_memory(streams_);
    streams_.build("memory", config_.memory, time_, options_);
}

std::size_t Gbu::finished_tiles() const {
    return sum_of(pixel_buffers_, &PixelBuffer::Stats::tiles);
}

} // namespace degs
