// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/gcc.hpp"

#include <algorithm>

#include "modules/stream_kinds.hpp"

namespace degs::gcc {
namespace {

constexpr StreamKind kMeans{"means", StreamData::Scene,
                            "Positions of all Gaussians, read by Stage I."};
constexpr StreamKind kGroupListsWritten{"group_lists_written", StreamData::Own,
                                        "Entries of the lists of groups, written by Stage I."};
constexpr StreamKind kGroupListsRead{"group_lists_read", StreamData::Own,
                                     "The same entries, read by Stage II group by group."};
constexpr StreamKind kShapes{"shapes", StreamData::Scene,
                             "Scale, rotation and opacity of listed Gaussians, read by Stage II."};

} // namespace

std::unique_ptr<RenderEngine> Config::build(const char* module, const Timebase& time,
                                            RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Engine>(module, *this, time, job, options);
}

Engine::Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), config_(config), time_(time), job_(job), options_(options),
      gated_(!options.array_only && job.has_more_frames_than(config.frames_in_flight)) {
    build_array();
    if (options_.array_only) {
        build_source();
    } else {
        build_stages();
    }
    frame_ends_.build(
        config_.frame_end, time_, config_.traffic.common(), job_, image_buffers_,
        {grouping_ ? grouping_->frame_free : nobody_, grouping_ ? grouping_->listed : nobody_}, 1,
        options_);
    build_memory();
}

void Engine::build_array() {
    const int contexts = config_.tile_contexts();
    const int writeback = config_.array.writeback_cycles;
    const bool mask = !options_.array_only && config_.colour.skip_ended;
    array_ = std::make_unique<WindowArray>("array", config_.array, time_, job_, 1, contexts,
                                           mask ? 1 : 0, config_.colour.block);
    image_buffers_.push_back(std::make_unique<PixelBuffer>(
        "image_buffer", config_.image_buffer, config_.traffic.common(), time_, job_, 1, contexts,
        PixelBuffer::Share{}, gated_ || options_.finished != nullptr, options_.array_only));
    monitor_ = std::make_unique<TileMonitor>("monitor", config_.monitor, time_, job_, 1,
                                             options_.array_only ? 1 : 3);
    auto& done = add_wire(done_rings_, "tile_done", time_, writeback);
    array_->tile_done.bind(done);
    image_buffers_[0]->in[0].bind(done);
    auto& state = add_wire(state_rings_, "tile_state", time_, writeback);
    array_->tile_state.bind(state);
    monitor_->in[0].bind(state);
    auto& free = add_wire(context_rings_, "context_free", time_, 1);
    image_buffers_[0]->context_free[0].bind(free);
    array_->context_free.bind(free);
    auto& splats = add_ring(splat_rings_, "splats", time_, config_.chunks_ahead(), 1);
    array_->in[0].bind(splats);
}

void Engine::bind_cancel(FifoPort<TileNumber>& listener) {
    auto& cancel = add_wire(cancel_rings_, "cancel", time_, config_.monitor.latency_cycles);
    monitor_->out[listeners_++].bind(cancel);
    listener.bind(cancel);
}

void Engine::build_stages() {
    grouping_ = std::make_unique<Grouping>("grouping", config_.grouping, config_.traffic, time_,
                                           job_, gated_ ? config_.frames_in_flight : 0, 1);
    projection_ = std::make_unique<ProjectionStage>("projection", config_.projection,
                                                    config_.traffic, time_, job_);
    colour_ = std::make_unique<ColourStage>("colour", config_.colour, config_.traffic, time_, job_,
                                            config_.projection.groups_ahead);
    auto& grouped = add_wire(grouped_rings_, "grouped", time_, 1);
    grouping_->out.bind(grouped);
    projection_->start.bind(grouped);
    auto& groups = add_ring(projected_rings_, "projected", time_, config_.projection.groups_ahead,
                            config_.projection.latency_cycles);
    projection_->out.bind(groups);
    colour_->in.bind(groups);
    colour_->out.bind(*splat_rings_[0]);
    bind_cancel(projection_->cancel[0]);
    bind_cancel(projection_->cancel[1]);
    bind_cancel(colour_->cancel);
    if (config_.colour.skip_ended) {
        auto& blocks = add_wire(block_rings_, "block_ended", time_,
                                config_.array.writeback_cycles + config_.colour.feedback_cycles);
        array_->block_ended[0].bind(blocks);
        colour_->block_ended[0].bind(blocks);
    }
}

void Engine::build_source() {
    source_ = std::make_unique<ListSource>("lists", time_, job_, 0, 1);
    SplatFetcher::Config fetching;
    fetching.chunk = config_.colour.chunk;
    fetcher_ = std::make_unique<SplatFetcher>("fetcher", fetching, config_.traffic.common(), time_,
                                              job_, 1, true);
    auto& lists = add_ring(sorted_rings_, "sorted", time_, 1, 1);
    source_->sorted.bind(lists);
    fetcher_->sorted.bind(lists);
    fetcher_->out[0].bind(*splat_rings_[0]);
    bind_cancel(fetcher_->cancel);
}

void Engine::build_memory() {
    if (grouping_) {
        streams_.connect(grouping_->means, kMeans);
        streams_.connect(grouping_->lists, kGroupListsWritten);
        streams_.connect(projection_->lists, kGroupListsRead);
        streams_.connect(projection_->shapes, kShapes);
        streams_.connect(colour_->sh, stream_kinds::kSh);
    } else {
        streams_.connect(fetcher_->records, stream_kinds::kSplatsRead);
    }
    streams_.connect(image_buffers_[0]->frame_buffer, stream_kinds::kFrameBuffer);
    frame_ends_.connect_memory(streams_);
    streams_.build("memory", config_.memory, time_, options_);
}

} // namespace degs::gcc
