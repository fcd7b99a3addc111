// SPDX-License-Identifier: Apache-2.0
#include "modules/degs.hpp"

#include <algorithm>
#include <string>

#include "modules/row_map.hpp"
#include "modules/span_engine/span_pool.hpp"
#include "modules/span_engine/span_unit.hpp"
#include "modules/stream_kinds.hpp"

namespace degs {

Degs::Degs(const sc_core::sc_module_name& name, const DegsConfig& config, const Timebase& time,
           RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), config_(config), time_(time), job_(job), options_(options) {
    build_front_end();
    build_fetchers();
    build_slicing();
    build_spans();
    build_scheduler();
    build_pixel_buffers();
    build_array();
    frame_ends_.build(config_.frame_end, time_, config_.traffic, job_, pixel_buffers_,
                      {front_end_->frame_free, front_end_->listed},
                      pixel_buffers_.size() / config_.streams(), options_);
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
    TileFrontEnd::Config front;
    front.projection = config_.projection;
    front.binning = config_.binning;
    front.sorting = config_.sorting;
    front.traffic = config_.traffic;
    front.sort_capacity = config_.sort_capacity();
    front.frames_in_flight = config_.frames_in_flight;
    front.instant = options_.array_only;
    front_end_ = std::make_unique<TileFrontEnd>("front_end", front, time_, job_);
}

// Each stream cancels its own tiles; a single one those of all fetchers.
void Degs::build_fetchers() {
    const int slicers = config_.slicing.modules();
    const bool granted = config_.slicing.granted();
    const int fetchers = config_.fetchers();
    const int of_stream = fetchers / config_.streams();
    for (int m = 0; m < config_.streams(); ++m) {
        monitors_.push_back(std::make_unique<TileMonitor>(
            numbered("monitor", monitors_.size()).c_str(), config_.monitor, time_, job_,
            config_.scheduler.banks, of_stream + slicers, granted));
    }
    for (int f = 0; f < fetchers; ++f) {
        fetchers_.push_back(std::make_unique<SplatFetcher>(
            numbered("fetcher", fetchers_.size()).c_str(), config_.fetching, config_.traffic, time_,
            job_, slicers, options_.array_only, granted));
        auto& cancel = wire(cancel_rings_, "cancel", config_.monitor.latency_cycles);
        monitors_[f / of_stream]->out[f % of_stream].bind(cancel);
        fetchers_[f]->cancel.bind(cancel);
    }
    if (granted) {
        grants_ = std::make_unique<TileGrants>(*front_end_, fetchers_, time_, job_);
        return;
    }
    for (int f = 0; f < fetchers; ++f) {
        auto& lists = ring(sorted_rings_, "sorted", 1, 1);
        front_end_->sorted[f].bind(lists);
        fetchers_[f]->sorted.bind(lists);
    }
}

void Degs::build_slicing() {
    const int slicers = config_.slicing.modules();
    const int of_stream = config_.fetchers() / config_.streams();
    for (int i = 0; i < config_.streams() * slicers; ++i) {
        const int g = i % slicers, m = i / slicers;
        slicing_.push_back(std::make_unique<GaussianSlicingUnit>(
            numbered("slicing", slicing_.size()).c_str(), config_.slicing, time_, job_, g,
            of_stream, config_.span_lanes(), reachable(g, slicers, config_.scheduler.banks),
            config_.scheduler.segment_length));
        GaussianSlicingUnit& unit = *slicing_.back();
        for (int f = 0; f < of_stream; ++f) {
            auto& splats = ring(gaussian_rings_, "gaussian_buffer", config_.gaussian_chunks(), 1);
            fetchers_[m * of_stream + f]->out[g].bind(splats);
            unit.in[f].bind(splats);
        }
        auto& cancel = wire(cancel_rings_, "cancel", config_.monitor.latency_cycles);
        monitors_[m]->out[of_stream + g].bind(cancel);
        unit.cancel.bind(cancel);
    }
}

std::unique_ptr<SpanStage> Degs::make_span_module(int index) {
    const std::string name = numbered("span", index);
    const int banks = config_.scheduler.banks;
    if (!config_.spans_are_pooled()) {
        return std::make_unique<SpanUnit>(name.c_str(), config_.span, time_, job_, index, banks);
    }
    SpanPool::Share share;
    share.index = index;
    share.of = config_.span.modules();
    share.banks = banks;
    share.streams = config_.streams();
    share.lanes = config_.span_lanes() / config_.span.modules();
    share.units = config_.span.units_per_module();
    return std::make_unique<SpanPool>(name.c_str(), config_.span, time_, job_, share);
}

// Lane l of a stream goes from its Slicing Unit l mod their number to module l mod the modules.
void Degs::build_spans() {
    const int modules = config_.span.modules();
    const int slicers = config_.slicing.modules();
    const int lanes = config_.span_lanes();
    for (int u = 0; u < modules; ++u) {
        spans_.push_back(make_span_module(u));
    }
    for (int m = 0; m < config_.streams(); ++m) {
        for (int l = 0; l < lanes; ++l) {
            auto& rows = ring(span_rings_, "span_buffer", config_.span_lane_depth(), 1);
            slicing_[m * slicers + l % slicers]->out[l / slicers].bind(rows);
            spans_[l % modules]->in[m * (lanes / modules) + l / modules].bind(rows);
        }
    }
}

void Degs::build_scheduler() {
    const DegsConfig::Scheduler& s = config_.scheduler;
    IssueBank::Config bank;
    bank.count = s.banks;
    bank.queue_depth = config_.queue_depth();
    bank.segment_length = s.segment_length;
    bank.segments_per_cycle = s.segments_per_cycle;
    bank.spans_per_cycle = config_.span.crossbar_width;
    bank.issue_width = s.issue_width;
    bank.reuse_cycles = s.reuse_cycles;
    bank.feature_entries = config_.feature_entries();
    bank.open_splats = config_.slicing.units_per_module();
    bank.streams = config_.streams();
    bank.scoreboard = s.scoreboard;
    bank.termination = s.termination;
    bank.scan = s.scan;
    const PackingUnit::Config packing{config_.array.pes_per_bank, config_.packing.latency_cycles,
                                      config_.packing_lead(), config_.packing.reorganisation};
    next_span_port_.assign(spans_.size(), 0);
    for (int b = 0; b < s.banks; ++b) {
        packing_.push_back(
            std::make_unique<PackingUnit>(numbered("packing", packing_.size()).c_str(), packing));
        banks_.push_back(std::make_unique<IssueBank>(
            numbered("bank", banks_.size()).c_str(), bank, time_, job_, *packing_.back(), b,
            reachable(b, s.banks, config_.span.modules()), config_.contexts_per_stream()));
        connect_crossbar(b);
    }
}

// Queues whose room is asked for tell it in the cycle after.
void Degs::connect_crossbar(int bank) {
    const int modules = config_.span.modules();
    const int release = config_.spans_are_pooled() ? 1 : 0;
    const std::size_t inputs = banks_[bank]->in.size() / config_.streams();
    std::size_t input = 0;
    for (int u = 0; u < modules; ++u) {
        if (!shares_row(u, modules, bank, config_.scheduler.banks)) {
            continue;
        }
        const std::size_t ports = spans_[u]->out.size() / config_.streams();
        for (int m = 0; m < config_.streams(); ++m) {
            auto& vectors = add_ring(crossbar_rings_, "crossbar", time_, config_.crossbar_cells(),
                                     config_.span.latency_cycles, release);
            spans_[u]->out[m * ports + next_span_port_[u]].bind(vectors);
            banks_[bank]->in[m * inputs + input].bind(vectors);
        }
        ++next_span_port_[u];
        ++input;
    }
}

void Degs::build_array() {
    const int writeback = config_.array.writeback_cycles;
    ArraySlice::Config slice;
    slice.width = config_.array.pes_per_bank;
    slice.writeback_cycles = writeback;
    slice.termination = config_.scheduler.termination;
    slice.region_listeners = config_.slicing.skip_dead_rows ? config_.slicing.modules() : 0;
    slice.streams = config_.streams();
    slice.contexts = config_.contexts_per_stream();
    slice.scoreboard = config_.scheduler.scoreboard;
    slice.tests = !config_.span.parsing;
    next_region_port_.assign(slicing_.size(), 0);
    for (int b = 0; b < config_.scheduler.banks; ++b) {
        slices_.push_back(std::make_unique<ArraySlice>(
            numbered("slice", slices_.size()).c_str(), slice, time_, job_, b,
            config_.scheduler.banks, config_.scheduler.segment_length));
        connect_slice(b);
    }
}

void Degs::connect_slice(int bank) {
    const std::size_t b = bank;
    const int writeback = config_.array.writeback_cycles;
    // The end of a tile takes no room of the Packing Buffer, but a cell of its ring. At most one of
    // every tile in flight waits there. As many packets as the latency has cycles are in the pipeline.
    const int latency = config_.packing.latency_cycles;
    const int tile_ends = std::max(4, config_.contexts());
    auto& packets = ring(packing_rings_, "packing_buffer",
                         config_.packing_depth() + latency + tile_ends, latency);
    packing_[b]->out.bind(packets);
    slices_[b]->in.bind(packets);
    auto& terminations = wire(termination_rings_, "terminations", writeback);
    slices_[b]->terminated.bind(terminations);
    banks_[b]->terminated.bind(terminations);
    if (config_.slicing.skip_dead_rows) {
        connect_region_feedback(bank);
    }
    const std::size_t parts = pixel_buffers_.size() / config_.streams(); // of a stream
    for (int m = 0; m < config_.streams(); ++m) {
        auto& done = wire(done_rings_, "tile_done", writeback);
        slices_[b]->tile_done[m].bind(done);
        PixelBuffer& pixels = *pixel_buffers_[m * parts + b % parts];
        pixels.in[b / parts].bind(done);
        auto& state = wire(state_rings_, "tile_state", writeback);
        slices_[b]->tile_state[m].bind(state);
        monitors_[m]->in[b].bind(state);
        auto& contexts = wire(context_rings_, "context_free", 1);
        pixels.context_free[b / parts].bind(contexts);
        banks_[b]->context_free[m].bind(contexts);
    }
}

// A share of the Pixel Buffer is read out at its share of the rate.
void Degs::build_pixel_buffers() {
    const int banks = config_.scheduler.banks;
    const bool banked = config_.pixel_buffer.release == ContextRelease::Bank;
    const int parts = banked ? banks : 1;
    PixelBuffer::Config config = config_.pixel_buffer;
    config.readout_pixels = std::max(1, config.readout_pixels / config_.streams());
    for (int i = 0; i < config_.streams() * parts; ++i) {
        PixelBuffer::Share share;
        share.first_row = i % parts;
        share.row_stride = parts;
        share.first_context = i / parts * config_.contexts_per_stream();
        share.granted = config_.slicing.granted();
        pixel_buffers_.push_back(std::make_unique<PixelBuffer>(
            numbered("pixel_buffer", pixel_buffers_.size()).c_str(), config, config_.traffic, time_,
            job_, banks / parts, config_.contexts_per_stream(), share,
            FrameEnds::awaited(front_end_->frame_free, options_), options_.array_only));
    }
}

void Degs::connect_region_feedback(int slice) {
    const int listeners = config_.slicing.modules();
    std::size_t port = 0;
    for (std::size_t i = 0; i < slicing_.size(); ++i) {
        const int g = static_cast<int>(i) % listeners;
        if (shares_row(slice, config_.scheduler.banks, g, listeners)) {
            auto& rows = wire(region_rings_, "region_ended", config_.slicing.feedback_cycles);
            slices_[slice]->region_ended[port++].bind(rows);
            slicing_[i]->region_ended[next_region_port_[i]++].bind(rows);
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

// Every part of a stream finishes its tiles by itself.
std::size_t Degs::finished_tiles() const {
    const std::size_t parts = pixel_buffers_.size() / config_.streams();
    std::uint64_t least = ~std::uint64_t{0};
    for (std::size_t part = 0; part < parts; ++part) {
        std::uint64_t tiles = 0;
        for (std::size_t i = part; i < pixel_buffers_.size(); i += parts) {
            tiles += pixel_buffers_[i]->stats().tiles;
        }
        least = std::min(least, tiles);
    }
    return least;
}

} // namespace degs
