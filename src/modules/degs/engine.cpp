// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/engine.hpp"

#include <algorithm>
#include <string>

#include "config/key_text.hpp"
#include "modules/kit/memory/stream_kinds.hpp"

namespace degs {
namespace {

/// A back end among several, so that its blocks have names of their own.
class Cluster : public sc_core::sc_module {
public:
    Cluster(const sc_core::sc_module_name& name, const DegsBackEnd::Shared& shared,
            DegsBlocks& blocks, int index)
        : sc_core::sc_module(name), back_end_(shared, blocks, index) {
        back_end_.build();
    }

private:
    DegsBackEnd back_end_;
};

} // namespace

Degs::Degs(const sc_core::sc_module_name& name, const DegsConfig& config, const Timebase& time,
           RenderJob& job, const BuildOptions& options)
    : RenderEngine(name), config_(config), time_(time), job_(job), options_(options) {
    if (is_functional_first()) {
        functional_ = make_functional_model(
            job_, {!config_.span.parsing, config_.slicing.rows, config_.slicing.modules()},
            {options_.kept, options_.kept == nullptr ? "" : key_text(config_.pipeline)});
    }
    build_front_end();
    build_supply();
    build_back_ends();
    frame_ends_.build(config_.frame_end, time_, config_.traffic, job_, blocks_.pixel_buffers,
                      {front_end_->frame_free, front_end_->listed},
                      blocks_.pixel_buffers.size() / config_.all_streams(), options_);
    build_memory();
}

// Strict mode blends tasks when they execute. So do runs whose pixels depend on that date, and
// tiles that are too wide or may be too many for FunctionalModel.
bool Degs::is_functional_first() const {
    const std::int64_t tiles_in_flight =
        config_.clusters * (std::int64_t{1} * config_.streams() * config_.span_lane_depth() +
                            config_.crossbar_cells() + config_.contexts());
    return time_.fidelity == Fidelity::Exact && config_.scheduler.scoreboard &&
           config_.tile_size <= kMostMaskColumns && tiles_in_flight < kMostContexts / 2;
}

std::vector<RenderEngine::BlockGroup> Degs::logged_blocks() const {
    const auto group = [](const char* kind, const auto& units) {
        BlockGroup blocks{kind, {}};
        for (const auto& unit : units) {
            blocks.blocks.push_back(unit.get());
        }
        return blocks;
    };
    return {group("slicing", blocks_.slicing), group("span", blocks_.spans),
            group("bank", blocks_.banks), group("slice", blocks_.slices)};
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

void Degs::build_supply() {
    if (!config_.front.built()) {
        return;
    }
    SplatSupply::Shape shape;
    shape.clusters = config_.clusters;
    shape.fetchers = config_.fetchers();
    shape.readers = config_.slicing.modules();
    shape.fetching = config_.chunk_writers();
    shape.instant = options_.array_only;
    supply_ = std::make_unique<SplatSupply>("splat_supply", config_.front, config_.traffic, time_,
                                            job_, shape);
}

void Degs::build_back_ends() {
    const DegsBackEnd::Shared shared{config_,           time_,   job_, *front_end_, supply_.get(),
                                     functional_.get(), options_};
    const auto grant_tiles = [&] {
        if (config_.granted()) {
            grants_ = std::make_unique<TileGrants>(*front_end_, blocks_.fetchers,
                                                   config_.grant_cycles, time_, job_);
        }
    };
    if (config_.clusters == 1) {
        DegsBackEnd back_end(shared, blocks_, 0);
        grant_tiles();
        back_end.build();
        return;
    }
    for (int k = 0; k < config_.clusters; ++k) {
        clusters_.push_back(
            std::make_unique<Cluster>(numbered("cluster", k).c_str(), shared, blocks_, k));
    }
    grant_tiles();
}

void Degs::build_memory() {
    front_end_->connect_memory(streams_, blocks_.fetchers);
    if (supply_) {
        streams_.connect_urgent(supply_->records, stream_kinds::kSplatsRead);
    }
    for (auto& unit : blocks_.pixel_buffers) {
        streams_.connect(unit->frame_buffer, stream_kinds::kFrameBuffer);
    }
    frame_ends_.connect_memory(streams_);
    streams_.build("memory", config_.memory, time_, options_);
}

Cycle Degs::finished() const {
    Cycle last = frame_ends_.background().stats().finished;
    for (const auto& unit : blocks_.pixel_buffers) {
        last = std::max(last, unit->stats().finished);
    }
    return last;
}

// Every part of a stream finishes its tiles by itself.
std::size_t Degs::finished_tiles() const {
    const std::size_t parts = blocks_.pixel_buffers.size() / config_.all_streams();
    std::uint64_t least = ~std::uint64_t{0};
    for (std::size_t part = 0; part < parts; ++part) {
        std::uint64_t tiles = 0;
        for (std::size_t i = part; i < blocks_.pixel_buffers.size(); i += parts) {
            tiles += blocks_.pixel_buffers[i]->stats().tiles;
        }
        least = std::min(least, tiles);
    }
    return least;
}

} // namespace degs
