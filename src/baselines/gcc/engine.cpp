// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/engine.hpp"

#include <algorithm>

#include "baselines/gcc/streams.hpp"
#include "modules/kit/memory/stream_kinds.hpp"

namespace degs::gcc {

std::unique_ptr<RenderEngine> Config::build(const char* module, const Timebase& time,
                                            RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Engine>(module, *this, time, job, options);
}

Engine::Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), config_(config), time_(time), job_(job), options_(options),
      gated_(!options.array_only && job.has_more_frames_than(config.frames_in_flight)) {
    for (int cluster = 0; cluster < config_.clusters; ++cluster) {
        build_array(cluster);
    }
    if (options_.array_only) {
        build_source();
    } else {
        build_stages();
    }
    if (granted()) {
        build_grants();
    }
    frame_ends_.build(
        config_.frame_end, time_, config_.traffic.common(), job_, image_buffers_,
        {grouping_ ? grouping_->frame_free : nobody_, grouping_ ? grouping_->listed : nobody_}, 1,
        options_);
    build_memory();
}

void Engine::build_array(int cluster) {
    const int contexts = config_.contexts();
    const int writeback = config_.array.writeback_cycles;
    const bool mask = !options_.array_only && config_.colour.skip_ended;
    const ArrayShare share{1, contexts, cluster * contexts, granted()};
    arrays_.push_back(std::make_unique<WindowArray>(name_of("array", cluster).c_str(),
                                                    config_.array, time_, job_, share, mask ? 1 : 0,
                                                    config_.colour.block));
    PixelBuffer::Share pixels;
    pixels.first_context = share.first_context;
    pixels.granted = share.granted;
    image_buffers_.push_back(std::make_unique<PixelBuffer>(
        name_of("image_buffer", cluster).c_str(), config_.image_buffer, config_.traffic.common(),
        time_, job_, 1, contexts, pixels, gated_ || options_.finished != nullptr,
        options_.array_only));
    monitors_.push_back(std::make_unique<TileMonitor>(name_of("monitor", cluster).c_str(),
                                                      config_.monitor, time_, job_, 1,
                                                      options_.array_only ? 1 : 3, granted()));
    WindowArray& array = *arrays_.back();
    auto& done = add_wire(done_rings_, "tile_done", time_, writeback);
    array.tile_done.bind(done);
    image_buffers_.back()->in[0].bind(done);
    auto& state = add_wire(state_rings_, "tile_state", time_, writeback);
    array.tile_state.bind(state);
    monitors_.back()->in[0].bind(state);
    auto& free = add_wire(context_rings_, "context_free", time_, config_.image_buffer.free_cycles);
    image_buffers_.back()->context_free[0].bind(free);
    array.context_free.bind(free);
    array.in[0].bind(add_ring(splat_rings_, "splats", time_, config_.chunks_ahead(), 1));
}

void Engine::bind_cancel(int cluster, std::size_t listener, FifoPort<TileNumber>& port) {
    auto& cancel = add_wire(cancel_rings_, "cancel", time_, config_.monitor.latency_cycles);
    monitors_[cluster]->out[listener].bind(cancel);
    port.bind(cancel);
}

void Engine::build_stages() {
    grouping_ =
        std::make_unique<Grouping>("grouping", config_.grouping, config_.traffic, time_, job_,
                                   gated_ ? config_.frames_in_flight : 0, 1, arrays_.size());
    for (int cluster = 0; cluster < config_.clusters; ++cluster) {
        build_stages_of(cluster);
    }
}

void Engine::build_stages_of(int cluster) {
    projection_.push_back(std::make_unique<ProjectionStage>(name_of("projection", cluster).c_str(),
                                                            config_.projection, config_.traffic,
                                                            time_, job_, granted()));
    colour_.push_back(std::make_unique<ColourStage>(name_of("colour", cluster).c_str(),
                                                    config_.colour, config_.traffic, time_, job_,
                                                    config_.projection.groups_ahead, granted()));
    ProjectionStage& projection = *projection_.back();
    ColourStage& colour = *colour_.back();
    auto& grouped = add_wire(grouped_rings_, "grouped", time_, 1);
    grouping_->out[cluster].bind(grouped);
    projection.start.bind(grouped);
    auto& groups = add_ring(projected_rings_, "projected", time_, config_.projection.groups_ahead,
                            config_.projection.latency_cycles);
    groups.set_billed(); // with the stage that projects
    projection.out.bind(groups);
    colour.in.bind(groups);
    colour.out.bind(*splat_rings_[cluster]);
    bind_cancel(cluster, 0, projection.cancel[0]);
    bind_cancel(cluster, 1, projection.cancel[1]);
    bind_cancel(cluster, 2, colour.cancel);
    if (config_.colour.skip_ended) {
        auto& blocks = add_wire(block_rings_, "block_ended", time_,
                                config_.array.writeback_cycles + config_.colour.feedback_cycles);
        arrays_[cluster]->block_ended[0].bind(blocks);
        colour.block_ended[0].bind(blocks);
    }
}

void Engine::build_source() {
    if (!granted()) {
        source_ = std::make_unique<ListSource>("lists", time_, job_, 0, 1);
    }
    for (int cluster = 0; cluster < config_.clusters; ++cluster) {
        build_fetcher(cluster);
    }
    if (!granted()) {
        auto& lists = add_ring(sorted_rings_, "sorted", time_, 1, 1);
        source_->sorted.bind(lists);
        fetchers_[0]->sorted.bind(lists);
    }
    for (int cluster = 0; cluster < config_.clusters; ++cluster) {
        fetchers_[cluster]->out[0].bind(*splat_rings_[cluster]);
        bind_cancel(cluster, 0, fetchers_[cluster]->cancel);
    }
}

void Engine::build_fetcher(int cluster) {
    SplatFetcher::Config fetching;
    fetching.chunk = config_.colour.chunk;
    fetchers_.push_back(std::make_unique<SplatFetcher>(name_of("fetcher", cluster).c_str(),
                                                       fetching, config_.traffic.common(), time_,
                                                       job_, 1, true, granted()));
}

// A view is granted before its frame has been grouped; Stage II waits for that.
void Engine::build_grants() {
    source_ = std::make_unique<ListSource>("views", time_, job_, 0, 1);
    dispatcher_ = std::make_unique<TileDispatcher>("dispatcher", time_, job_, 1, arrays_.size());
    auto& all = add_ring(sorted_rings_, "views", time_, 1, 1);
    source_->sorted.bind(all);
    dispatcher_->in[0].bind(all);
    for (std::size_t cluster = 0; cluster < arrays_.size(); ++cluster) {
        auto& request = add_ring(request_rings_, "request", time_, 2, config_.grant_cycles);
        auto& grant = add_ring(grant_rings_, "grant", time_, 2, config_.grant_cycles);
        dispatcher_->request[cluster].bind(request);
        dispatcher_->out[cluster].bind(grant);
        if (grouping_) {
            projection_[cluster]->request[0].bind(request);
            projection_[cluster]->views[0].bind(grant);
        } else {
            fetchers_[cluster]->request[0].bind(request);
            fetchers_[cluster]->sorted.bind(grant);
        }
    }
}

void Engine::build_memory() {
    if (grouping_) {
        streams_.connect(grouping_->means, kMeans);
        streams_.connect(grouping_->lists, kGroupListsWritten);
    }
    for (std::size_t cluster = 0; cluster < projection_.size(); ++cluster) {
        streams_.connect_urgent(projection_[cluster]->lists, kGroupListsRead);
        streams_.connect_urgent(projection_[cluster]->shapes, kShapes);
        streams_.connect_urgent(colour_[cluster]->sh, stream_kinds::kSh);
    }
    for (auto& fetcher : fetchers_) {
        streams_.connect_urgent(fetcher->records, stream_kinds::kSplatsRead);
    }
    for (auto& buffer : image_buffers_) {
        streams_.connect(buffer->frame_buffer, stream_kinds::kFrameBuffer);
    }
    frame_ends_.connect_memory(streams_);
    streams_.build("memory", config_.memory, time_, options_);
}

} // namespace degs::gcc
