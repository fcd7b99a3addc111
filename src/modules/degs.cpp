// SPDX-License-Identifier: Apache-2.0
#include "modules/degs.hpp"

#include <algorithm>
#include <string>

#include "modules/row_map.hpp"
#include "modules/stream_kinds.hpp"

namespace degs {

Degs::Degs(const sc_core::sc_module_name& name, const DegsConfig& config, const Timebase& time,
           RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), config_(config), time_(time), job_(job), options_(options) {
    build_front_end();
    build_span_engine();
    build_scheduler();
    build_array();
    frame_ends_.build(config_.frame_end, time_, config_.traffic, job_, pixel_buffers_,
                      {front_end_->frame_free, front_end_->listed}, pixel_buffers_.size(),
                      options_);
    build_memory();
}

std::unique_ptr<RenderEngine> DegsConfig::build(const char* module, const Timebase& time,
                                                RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Degs>(module, *this, time, job, options);
}

template <class T>
DatedFifo<T>& Degs::ring(Rings<T>& rings, const char* name, int depth, int latency) {
    return add_ring(rings, name, time_, depth, latency);
}

template <class T>
DatedFifo<T>& Degs::wire(Rings<T>& rings, const char* name, int latency) {
    return add_wire(rings, name, time_, latency);
}

void Degs::build_front_end() {
    const std::size_t sorters = config_.sorting.count;
    const std::size_t slicers = config_.slicing.modules();
    TileFrontEnd::Config front;
    front.projection = config_.projection;
    front.binning = config_.binning;
    front.sorting = config_.sorting;
    front.traffic = config_.traffic;
    front.sort_capacity = config_.sort_capacity();
    front.frames_in_flight = config_.frames_in_flight;
    front.instant = options_.array_only;
    front_end_ = std::make_unique<TileFrontEnd>("front_end", front, time_, job_);
    monitor_ = std::make_unique<TileMonitor>("monitor", config_.monitor, time_, job_,
                                             config_.scheduler.banks, sorters + slicers);
    for (std::size_t i = 0; i < sorters; ++i) {
        fetchers_.push_back(std::make_unique<SplatFetcher>(numbered("fetcher", i).c_str(),
                                                           config_.fetching, config_.traffic, time_,
                                                           job_, slicers, options_.array_only));
        auto& lists = ring(sorted_rings_, "sorted", 1, 1);
        front_end_->sorted[i].bind(lists);
        fetchers_[i]->sorted.bind(lists);
        auto& cancel = wire(cancel_rings_, "cancel", config_.monitor.latency_cycles);
        monitor_->out[i].bind(cancel);
        fetchers_[i]->cancel.bind(cancel);
    }
}

void Degs::build_span_engine() {
    const auto sorters = fetchers_.size();
    const int lanes = config_.span.count;
    const int slicers = config_.slicing.modules();
    for (int g = 0; g < slicers; ++g) {
        slicing_.push_back(std::make_unique<GaussianSlicingUnit>(
            numbered("slicing", slicing_.size()).c_str(), config_.slicing, time_, job_, g, sorters,
            lanes, reachable(g, slicers, config_.scheduler.banks),
            config_.scheduler.segment_length));
        GaussianSlicingUnit& unit = *slicing_.back();
        for (std::size_t s = 0; s < sorters; ++s) {
            auto& splats = ring(gaussian_rings_, "gaussian_buffer", config_.gaussian_chunks(), 1);
            fetchers_[s]->out[g].bind(splats);
            unit.in[s].bind(splats);
        }
        auto& cancel = wire(cancel_rings_, "cancel", config_.monitor.latency_cycles);
        monitor_->out[sorters + g].bind(cancel);
        unit.cancel.bind(cancel);
    }
    for (int u = 0; u < lanes; ++u) {
        spans_.push_back(std::make_unique<SpanUnit>(numbered("span", spans_.size()).c_str(),
                                                    config_.span, time_, job_, u,
                                                    config_.scheduler.banks));
        auto& rows = ring(span_rings_, "span_buffer", config_.span_lane_depth(), 1);
        slicing_[u % slicers]->out[u / slicers].bind(rows);
        spans_.back()->in.bind(rows);
    }
}

void Degs::build_scheduler() {
    const DegsConfig::Scheduler& s = config_.scheduler;
    IssueBank::Config bank;
    bank.count = s.banks;
    bank.queue_depth = config_.queue_depth();
    bank.segment_length = s.segment_length;
    bank.segments_per_cycle = s.segments_per_cycle;
    bank.issue_width = s.issue_width;
    bank.reuse_cycles = s.reuse_cycles;
    bank.feature_entries = config_.feature_entries();
    bank.open_splats = config_.slicing.units_per_module();
    bank.scoreboard = s.scoreboard;
    bank.termination = s.termination;
    bank.scan = s.scan;
    const PackingUnit::Config packing{config_.array.pes_per_bank, config_.packing.latency_cycles,
                                      config_.packing_lead()};
    std::vector<std::size_t> next_port(spans_.size(), 0);
    for (int b = 0; b < s.banks; ++b) {
        std::vector<std::size_t> sources;
        for (int u = 0; u < config_.span.count; ++u) {
            if (shares_row(u, config_.span.count, b, s.banks)) {
                sources.push_back(u);
            }
        }
        packing_.push_back(
            std::make_unique<PackingUnit>(numbered("packing", packing_.size()).c_str(), packing));
        banks_.push_back(std::make_unique<IssueBank>(numbered("bank", banks_.size()).c_str(), bank,
                                                     time_, job_, *packing_.back(), b,
                                                     sources.size(), config_.contexts()));
        for (std::size_t i = 0; i < sources.size(); ++i) {
            auto& vectors = ring(crossbar_rings_, "crossbar", config_.crossbar_cells(),
                                 config_.span.latency_cycles);
            spans_[sources[i]]->out[next_port[sources[i]]++].bind(vectors);
            banks_.back()->in[i].bind(vectors);
        }
    }
}

void Degs::build_array() {
    build_pixel_buffer();
    const int writeback = config_.array.writeback_cycles;
    const ArraySlice::Config slice{config_.array.pes_per_bank, writeback,
                                   config_.scheduler.termination,
                                   config_.slicing.skip_dead_rows ? config_.slicing.modules() : 0,
                                   config_.scheduler.scoreboard};
    next_region_port_.assign(slicing_.size(), 0);
    // The end of a tile takes no room of the Packing Buffer, but a cell of its ring. At most one of
    // every tile in flight waits there.
    const int tile_ends = std::max(4, config_.contexts());
    for (int b = 0; b < config_.scheduler.banks; ++b) {
        const std::size_t i = b;
        slices_.push_back(std::make_unique<ArraySlice>(numbered("slice", i).c_str(), slice, time_,
                                                       job_, b, config_.scheduler.banks,
                                                       config_.scheduler.segment_length));
        const int latency = config_.packing.latency_cycles; // as many packets are in the pipeline
        auto& packets = ring(packing_rings_, "packing_buffer",
                             config_.packing_depth() + latency + tile_ends, latency);
        packing_[i]->out.bind(packets);
        slices_[i]->in.bind(packets);
        auto& terminations = wire(termination_rings_, "terminations", writeback);
        slices_[i]->terminated.bind(terminations);
        banks_[i]->terminated.bind(terminations);
        connect_region_feedback(b, slice.region_listeners);
        auto& done = wire(done_rings_, "tile_done", writeback);
        slices_[i]->tile_done.bind(done);
        PixelBuffer& pixels = *pixel_buffers_[i % pixel_buffers_.size()];
        const std::size_t port = i / pixel_buffers_.size();
        pixels.in[port].bind(done);
        auto& state = wire(state_rings_, "tile_state", writeback);
        slices_[i]->tile_state.bind(state);
        monitor_->in[i].bind(state);
        auto& contexts = wire(context_rings_, "context_free", 1);
        pixels.context_free[port].bind(contexts);
        banks_[i]->context_free.bind(contexts);
    }
}

void Degs::build_pixel_buffer() {
    const int banks = config_.scheduler.banks;
    const bool banked = config_.pixel_buffer.release == ContextRelease::Bank;
    for (int b = 0; b < (banked ? banks : 1); ++b) {
        PixelBuffer::Share share;
        share.first_row = b;
        share.row_stride = banked ? banks : 1;
        pixel_buffers_.push_back(std::make_unique<PixelBuffer>(
            numbered("pixel_buffer", pixel_buffers_.size()).c_str(), config_.pixel_buffer,
            config_.traffic, time_, job_, banked ? 1 : banks, config_.contexts(), share,
            FrameEnds::awaited(front_end_->frame_free, options_), options_.array_only));
    }
}

void Degs::connect_region_feedback(int slice, int listeners) {
    std::size_t port = 0;
    for (int g = 0; g < listeners; ++g) {
        if (shares_row(slice, config_.scheduler.banks, g, listeners)) {
            auto& rows = wire(region_rings_, "region_ended", config_.slicing.feedback_cycles);
            slices_[slice]->region_ended[port++].bind(rows);
            slicing_[g]->region_ended[next_region_port_[g]++].bind(rows);
        }
    }
}

void Degs::build_memory() {
    front_end_->connect_memory(streams_, fetchers_);
    for (auto& unit : pixel_buffers_) {
        streams_.connect(unit->frame_buffer, stream_kinds::kFrameBuffer);
    }
    frame_ends_.connect_memory(streams_);
    streams_.build("memory", config_.memory, time_, options_);
}

Cycle Degs::finished() const {
    Cycle last = frame_ends_.background().stats().finished;
    for (const auto& unit : pixel_buffers_) {
        last = std::max(last, unit->stats().finished);
    }
    return last;
}

std::size_t Degs::finished_tiles() const {
    std::uint64_t tiles = ~std::uint64_t{0};
    for (const auto& part : pixel_buffers_) {
        tiles = std::min(tiles, part->stats().tiles);
    }
    return tiles;
}

} // namespace degs
