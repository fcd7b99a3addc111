// SPDX-License-Identifier: Apache-2.0
// GCC without simulation: its array takes a slot for every window that a splat's traversal visits
// and that has not ended. See docs/analytic.md.
#include <algorithm>
#include <cmath>

#include "baselines/gcc/config.hpp"
#include "baselines/gcc/footprint.hpp"
#include "modules/kit/analytic/front_end_load.hpp"

namespace degs::gcc {
namespace {

class Analytic : public AnalyticModel {
public:
    explicit Analytic(const Config& config)
        : config_(config), memory_(config.memory, config.clock_ghz) {}
    std::vector<cost::Activity> activity(const FrameWorkload& frame, const PreparationCycles&,
                                         const TileCycles& tiles) const override {
        Work work;
        work.means = static_cast<double>(frame.gaussians);
        work.entries = work.shapes = work.coloured = tiles.walked;
        work.slots = tiles.slots;
        std::vector<cost::Activity> all = config_.activity(work, false);
        all.push_back(pixel_activity(tiles, config_.pixel_bytes()));
        return all;
    }
    const MainMemoryConfig& main_memory() const override { return config_.memory; }
    std::vector<std::string> units() const override {
        return {"grouping", "projection", "colour", "blending", "memory"};
    }
    PreparationCycles preparation(const FrameWorkload& frame) const override;
    std::unique_ptr<TileClock> clock(const FrameWorkload& frame) const override;
    CoarseTile::Options coarse_options() const override {
        return {config_.array.window, config_.array.window};
    }
    // Rows of windows; four rows of pixels tell which windows a splat meets.
    Blocks blocks() const override {
        return {config_.array.window, config_.view_size / config_.array.window,
                std::max(1, config_.array.window / 4)};
    }
    double visits_per_entry() const override { return 3; } // neighbours
    int engines() const override { return config_.clusters; }
    Places places() const override {
        return {std::size_t{4} * config_.projection.groups_ahead, 1.0 * config_.projection.group};
    }
    double memory_latency() const override { return memory_.latency; }
    TileCycles background(double pixels) const override {
        return memory_.writes(pixels * config_.traffic.pixel_bytes, kMemory);
    }
    double latency() const override { return 6 * memory_.latency; }
    int pes() const override { return config_.pes(); }
    std::optional<EstimateErrors> errors() const override { return EstimateErrors{0.04, 0.055}; }

    enum Unit : std::size_t { kGrouping, kProjection, kColour, kBlending, kMemory };
    const Config& config() const { return config_; }
    const MemoryRate& memory() const { return memory_; }

private:
    Config config_;
    MemoryRate memory_;
};

class Clock : public TileClock {
public:
    Clock(const Analytic& model, const FrameWorkload& frame)
        : model_(model), frame_(frame), side_(model.config().array.window) {}
    void begin(const CoarseTile&) override { windows_ = 0; }
    void splat(const CoarseTile& tile) override;
    TileCycles end(const CoarseTile& tile) override;

private:
    WindowMask windows_of(const CoarseSpan& span) const {
        return span.first <= span.last ? windows_between(span.first / side_, span.last / side_) : 0;
    }

    WindowMask visited(const CoarseTile& tile, int row, const CoarseSpan* spans,
                       const CoarseSpan* end) const;

    const Analytic& model_;
    const FrameWorkload& frame_;
    int side_;
    double windows_ = 0;
};

std::unique_ptr<TileClock> Analytic::clock(const FrameWorkload& frame) const {
    return std::make_unique<Clock>(*this, frame);
}

PreparationCycles Analytic::preparation(const FrameWorkload& frame) const {
    const double gaussians = static_cast<double>(frame.gaussians);
    const double entries = static_cast<double>(frame.tile_pairs());
    const Grouping::Config& grouping = config_.grouping;
    PreparationCycles result;
    result.bytes = gaussians * static_cast<double>(config_.traffic.stage_one_bytes()) +
                   entries * config_.traffic.list_entry_bytes;
    result.written = entries * config_.traffic.list_entry_bytes;
    const double group =
        std::max(gaussians / grouping.means_per_cycle, entries / grouping.entries_per_cycle);
    const double in_flight = 1.0 * grouping.chunk * grouping.chunks_in_flight;
    const double moved = memory_.cycles(result.bytes);
    result.busy[kGrouping] = group;
    result.busy[kMemory] = moved;
    result.time =
        std::max({group, moved, gaussians / in_flight * memory_.latency}) + 2 * memory_.latency;
    return result;
}

/// The windows of one row of windows that the traversal visits: those with a valid pixel, and
/// neighbours across a side with one, whether or not they have any.
WindowMask Clock::visited(const CoarseTile& tile, int row, const CoarseSpan* spans,
                          const CoarseSpan* end) const {
    WindowMask visited = 0;
    for (; spans != end; ++spans) {
        visited |= windows_of(*spans);
        if (spans->first > tile.columns().first) {
            visited |= windows_of({spans->row, spans->first - 1, spans->first - 1});
        }
        if (spans->last < tile.columns().last) {
            visited |= windows_of({spans->row, spans->last + 1, spans->last + 1});
        }
    }
    for (const int tip : {tile.first_row(), tile.last_row()}) { // may lie between sampled rows
        if (tip / side_ == row) {
            visited |= windows_of(tile.span_of(tip));
        }
    }
    const int above = row * side_ - 1, below = (row + 1) * side_;
    if (above >= tile.first_row() && above <= tile.last_row()) {
        visited |= windows_of(tile.span_of(above));
    }
    if (below <= tile.last_row() && below >= tile.first_row()) {
        visited |= windows_of(tile.span_of(below));
    }
    return visited;
}

void Clock::splat(const CoarseTile& tile) {
    const CoarseSpan* span = tile.spans().begin();
    const CoarseSpan* const end = tile.spans().end();
    for (const int row : tile.blocks()) {
        const CoarseSpan* const first = span;
        while (span != end && span->row < (row + 1) * side_) {
            ++span;
        }
        // The traversal crosses a side, so that a row of windows next to the box counts, too.
        if ((row + 1) * side_ < tile.first_row() || row * side_ - 1 > tile.last_row()) {
            continue;
        }
        for (WindowMask left = visited(tile, row, first, span); left != 0; left &= left - 1) {
            const int column = __builtin_ctzll(left) * side_;
            windows_ += tile.cell_is_live(row * side_, column) ? 1 : 0;
        }
    }
}

TileCycles Clock::end(const CoarseTile& tile) {
    const Config& config = model_.config();
    const double walked = tile.walked();
    const auto alone = [&](std::uint64_t record) {
        return scattered_bytes(static_cast<int>(record), config.traffic.burst_bytes);
    };
    const TrafficConfig records = config.traffic.common();
    const double gaussian = config.traffic.list_entry_bytes + alone(records.shape_size()) +
                            alone(records.sh_size(frame_.sh_degree));
    TileCycles cycles;
    cycles.slots = windows_ * tile.block_weight() * config.array.pes();
    cycles.fragments = tile.fragments();
    cycles.written = tile.pixels() * config.traffic.pixel_bytes;
    cycles.bytes = walked * gaussian + tile.pixels() * config.traffic.pixel_bytes;
    const double passes =
        std::ceil(std::log(config.projection.group) / std::log(config.colour.merge_ways));
    cycles.walked = walked;
    UnitCycles& busy = cycles.busy; // first of the cluster of this view, then of all of them
    busy[Analytic::kProjection] =
        walked * config.projection.project_cycles(frame_.projection.rule) / config.projection.units;
    busy[Analytic::kColour] =
        walked * std::max(1.0 * config.colour.cycles_per_colour / config.colour.units,
                          passes / config.colour.keys_per_cycle);
    busy[Analytic::kBlending] = cycles.slots / config.array.pes();
    busy[Analytic::kMemory] = model_.memory().cycles(cycles.bytes);
    // The array waits until the only context has been read out.
    cycles.time = *std::max_element(busy.begin(), busy.end()) + config.array.writeback_cycles +
                  tile.pixels() / config.image_buffer.readout_pixels;
    for (const auto unit : {Analytic::kProjection, Analytic::kColour, Analytic::kBlending}) {
        busy[unit] /= config.clusters;
    }
    return cycles;
}

} // namespace

std::unique_ptr<AnalyticModel> Config::analytic() const {
    return std::make_unique<Analytic>(*this);
}

} // namespace degs::gcc
