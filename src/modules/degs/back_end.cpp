// SPDX-License-Identifier: Apache-2.0
// Builds the part of a back end from the Splat Fetchers to the crossbar.
#include "modules/degs/back_end.hpp"

#include "modules/degs/span_engine/span_pool.hpp"
#include "modules/degs/span_engine/span_unit.hpp"
#include "modules/kit/job/row_map.hpp"

namespace degs {

DegsBackEnd::DegsBackEnd(const Shared& shared, DegsBlocks& blocks, int index)
    : config_(shared.config), time_(shared.time), job_(shared.job), front_end_(shared.front_end),
      supply_(shared.supply), functional_(shared.functional), options_(shared.options),
      index_(index), fetchers_(blocks.fetchers), slicing_(blocks.slicing),
      releases_(blocks.releases), spans_(blocks.spans), banks_(blocks.banks),
      packing_(blocks.packing), slices_(blocks.slices), pixel_buffers_(blocks.pixel_buffers),
      monitors_(blocks.monitors), sorted_rings_(blocks.sorted),
      request_rings_(blocks.splat_requests), gaussian_rings_(blocks.gaussian_buffer),
      span_rings_(blocks.span_buffer), crossbar_rings_(blocks.crossbar),
      packing_rings_(blocks.packing_buffer), termination_rings_(blocks.terminations),
      region_rings_(blocks.region_ended), done_rings_(blocks.tile_done),
      state_rings_(blocks.tile_state), sliced_rings_(blocks.sliced),
      row_count_rings_(blocks.row_counts), solved_rings_(blocks.solved),
      place_rings_(blocks.places), context_rings_(blocks.context_free),
      cancel_rings_(blocks.cancel) {
    build_fetchers();
}

void DegsBackEnd::build() {
    build_slicing();
    build_spans();
    build_scheduler();
    build_pixel_buffers();
    build_array();
}

// Each stream cancels its own tiles; a single one those of all fetchers.
void DegsBackEnd::build_fetchers() {
    const int slicers = config_.slicing.modules();
    const bool granted = config_.granted();
    const int fetchers = config_.fetchers();
    const int of_stream = fetchers_of_stream();
    SplatFetcher::Config fetching = supply_ != nullptr ? config_.fetching : config_.chunk_writers();
    if (supply_ != nullptr) {
        fetching.reads = false;
        fetching.chunks = fetching.chunks_in_flight;
    }
    for (int m = 0; m < config_.streams(); ++m) {
        monitors_.add(std::make_unique<TileMonitor>(
            numbered("monitor", monitors_.size()).c_str(), config_.monitor, time_, job_,
            config_.scheduler.banks, of_stream + slicers, granted));
    }
    for (int f = 0; f < fetchers; ++f) {
        fetchers_.add(std::make_unique<SplatFetcher>(
            numbered("fetcher", fetchers_.size()).c_str(), fetching, config_.traffic, time_, job_,
            supply_ != nullptr ? 1 : slicers, options_.array_only, granted));
        if (supply_ != nullptr) {
            connect_supply(f);
        }
        auto& cancel = wire(cancel_rings_, "cancel", config_.monitor.latency_cycles);
        monitors_[f / of_stream]->out[f % of_stream].bind(cancel);
        fetchers_[f]->cancel.bind(cancel);
    }
    for (int f = 0; f < fetchers && !granted; ++f) {
        auto& lists = ring(sorted_rings_, "sorted", 1, 1);
        front_end_.sorted[f].bind(lists);
        fetchers_[f]->sorted.bind(lists);
    }
}

// Fetchers ask the supply, which writes to the Gaussian Buffer in their place.
void DegsBackEnd::connect_supply(int fetcher) {
    auto& requests = ring(request_rings_, "splat_requests", 2, config_.front.request_cycles);
    fetchers_[fetcher]->out[0].bind(requests);
    auto& taken = wire(place_rings_, "chunk_taken", config_.front.request_cycles);
    const int number = index_ * config_.fetchers() + fetcher;
    supply_->in[number].bind(requests);
    supply_->taken[number].bind(taken);
    fetchers_[fetcher]->released[0].bind(taken);
}

FifoPort<SplatChunk>& DegsBackEnd::splats_to(int slicer, int fetcher) {
    return supply_ != nullptr ? supply_->outlet(index_ * config_.fetchers() + fetcher).out[slicer]
                              : fetchers_[fetcher]->out[slicer];
}

FifoPort<ChunkReleased>& DegsBackEnd::places_from(int slicer, int fetcher) {
    return supply_ != nullptr
               ? supply_->outlet(index_ * config_.fetchers() + fetcher).released[slicer]
               : fetchers_[fetcher]->released[slicer];
}

void DegsBackEnd::build_slicing() {
    const int slicers = config_.slicing.modules();
    const int of_stream = fetchers_of_stream();
    GaussianSlicingUnit::Config config = config_.slicing;
    config.splat_ports = config_.gaussian_buffer.ports;
    config.row_ports = config_.span_buffer.ports;
    config.reports_chunks = config_.parameters_wait();
    config.granted = config_.granted();
    for (int i = 0; i < config_.streams() * slicers; ++i) {
        const int g = i % slicers, m = i / slicers;
        slicing_.add(std::make_unique<GaussianSlicingUnit>(
            numbered("slicing", slicing_.size()).c_str(), config, time_, job_, g, of_stream,
            config_.span_lanes(), reachable(g, slicers, config_.scheduler.banks),
            config_.scheduler.segment_length));
        GaussianSlicingUnit& unit = slicing_.back();
        if (functional_ != nullptr) {
            unit.replay(*functional_);
        }
        for (int f = 0; f < of_stream; ++f) {
            auto& splats = ring(gaussian_rings_, "gaussian_buffer", config_.gaussian_chunks(), 1);
            splats_to(g, m * of_stream + f).bind(splats);
            unit.in[f].bind(splats);
        }
        auto& cancel = wire(cancel_rings_, "cancel", config_.monitor.latency_cycles);
        monitors_[m]->out[of_stream + g].bind(cancel);
        unit.cancel.bind(cancel);
    }
}

std::unique_ptr<SpanStage> DegsBackEnd::make_span_module(int index) {
    const std::string name = numbered("span", index);
    const int banks = config_.scheduler.banks;
    SpanStage::Config config = config_.span;
    config.row_ports = config_.span_buffer.ports;
    config.reports_rows = config_.parameters_wait();
    config.replays = functional_ != nullptr;
    config.granted = config_.granted();
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
void DegsBackEnd::build_spans() {
    const int modules = config_.span.modules();
    const int slicers = config_.slicing.modules();
    const int lanes = config_.span_lanes();
    for (int u = 0; u < modules; ++u) {
        spans_.add(make_span_module(u));
    }
    for (int m = 0; m < config_.streams(); ++m) {
        for (int l = 0; l < lanes; ++l) {
            auto& rows = ring(span_rings_, "span_buffer", config_.span_lane_depth(), 1);
            slicing_[m * slicers + l % slicers]->out[l / slicers].bind(rows);
            spans_[l % modules]->in[m * (lanes / modules) + l / modules].bind(rows);
            slicing_[m * slicers + l % slicers]->write_to(l / slicers, *spans_[l % modules]);
        }
    }
    if (config_.parameters_wait()) {
        build_parameter_release();
    }
}

// Every Slicing module has its lanes, and a copy of what each of its fetchers sends.
void DegsBackEnd::build_parameter_release() {
    const int modules = config_.span.modules();
    const int slicers = config_.slicing.modules();
    const int lanes = config_.span_lanes();
    const int of_stream = fetchers_of_stream();
    for (std::size_t i = 0; i < slicing_.size(); ++i) {
        const int g = static_cast<int>(i) % slicers, m = static_cast<int>(i) / slicers;
        releases_.add(std::make_unique<ParameterRelease>(numbered("parameter_release", i).c_str(),
                                                         time_, lanes / slicers, of_stream));
        ParameterRelease& release = releases_.back();
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
            places_from(g, m * of_stream + f).bind(places);
        }
    }
}

} // namespace degs
