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
    if (draws_ahead()) {
        drawing_ = make_tile_drawing(
            job_, {!config_.span.parsing, config_.slicing.rows, config_.slicing.modules()});
    }
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

// Strict mode blends tasks when they execute. So do runs whose pixels depend on that date, and tiles that are too wide
// or may be too many for TileDrawing.
bool Degs::draws_ahead() const {
    const std::int64_t tiles_in_flight =
        std::int64_t{1} * config_.streams() * config_.span_lane_depth() + config_.crossbar_cells() +
        config_.contexts();
    return time_.fidelity == Fidelity::Exact && config_.scheduler.scoreboard &&
           config_.tile_size <= kMostDrawnColumns && tiles_in_flight < kMostContexts / 2;
}

std::unique_ptr<RenderEngine> DegsConfig::build(const char* module, const Timebase& time,
                                                RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Degs>(module, *this, time, job, options);
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
    SplatFetcher::Config fetching = config_.fetching;
    fetching.splat_ports = config_.gaussian_buffer.ports;
    fetching.chunks = config_.parameters_wait() ? config_.gaussian_chunks() : 0;
    for (int m = 0; m < config_.streams(); ++m) {
        monitors_.push_back(std::make_unique<TileMonitor>(
            numbered("monitor", monitors_.size()).c_str(), config_.monitor, time_, job_,
            config_.scheduler.banks, of_stream + slicers, granted));
    }
    for (int f = 0; f < fetchers; ++f) {
        fetchers_.push_back(std::make_unique<SplatFetcher>(
            numbered("fetcher", fetchers_.size()).c_str(), fetching, config_.traffic, time_, job_,
            slicers, options_.array_only, granted));
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
    GaussianSlicingUnit::Config config = config_.slicing;
    config.splat_ports = config_.gaussian_buffer.ports;
    config.row_ports = config_.span_buffer.ports;
    config.reports_chunks = config_.parameters_wait();
    for (int i = 0; i < config_.streams() * slicers; ++i) {
        const int g = i % slicers, m = i / slicers;
        slicing_.push_back(std::make_unique<GaussianSlicingUnit>(
            numbered("slicing", slicing_.size()).c_str(), config, time_, job_, g, of_stream,
            config_.span_lanes(), reachable(g, slicers, config_.scheduler.banks),
            config_.scheduler.segment_length));
        GaussianSlicingUnit& unit = *slicing_.back();
        if (drawing_) {
            unit.draw_with(*drawing_);
        }
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
    SpanStage::Config config = config_.span;
    config.row_ports = config_.span_buffer.ports;
    config.reports_rows = config_.parameters_wait();
    config.drawn = drawing_ != nullptr;
    if (!config_.spans_are_pooled()) {
        return std::make_unique<SpanUnit>(name.c_str(), config, time_, job_, index, banks);
    }
    SpanPool::Share share;
    share.index = index;
    share.of = config_.span.modules();
    share.banks = banks;
    share.streams = config_.streams();
    share.lanes = config_.span_lanes() / config_.span.modules();
    share.units = config_.span.units_per_module();
    return std::make_unique<SpanPool>(name.c_str(), config, time_, job_, share);
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
    if (config_.parameters_wait()) {
        build_parameter_release();
    }
}

// Every Slicing module has its lanes, and a copy of what each of its fetchers sends.
void Degs::build_parameter_release() {
    const int modules = config_.span.modules();
    const int slicers = config_.slicing.modules();
    const int lanes = config_.span_lanes();
    const int of_stream = config_.fetchers() / config_.streams();
    for (std::size_t i = 0; i < slicing_.size(); ++i) {
        const int g = static_cast<int>(i) % slicers, m = static_cast<int>(i) / slicers;
        releases_.push_back(std::make_unique<ParameterRelease>(
            numbered("parameter_release", i).c_str(), time_, lanes / slicers, of_stream));
        ParameterRelease& release = *releases_.back();
        auto& sliced = wire(sliced_rings_, "sliced", 1);
        slicing_[i]->sliced[0].bind(sliced);
        release.sliced.bind(sliced);
        for (int l = g; l < lanes; l += slicers) {
            auto& counts = wire(row_count_rings_, "row_counts", 1);
            slicing_[i]->row_counts[l / slicers].bind(counts);
            release.rows[l / slicers].bind(counts);
            auto& solved = wire(solved_rings_, "rows_solved", config_.span.latency_cycles);
            spans_[l % modules]->solved[m * (lanes / modules) + l / modules].bind(solved);
            release.solved[l / slicers].bind(solved);
        }
        for (int f = 0; f < of_stream; ++f) {
            auto& places = wire(place_rings_, "chunk_released", 1);
            release.released[f].bind(places);
            fetchers_[m * of_stream + f]->released[g].bind(places);
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
