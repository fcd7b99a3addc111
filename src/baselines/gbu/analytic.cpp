// SPDX-License-Identifier: Apache-2.0
// GBU without simulation: the rows of a tile run in step within the depth of their queues. See
// docs/analytic.md.
#include <algorithm>

#include "baselines/gbu/config.hpp"
#include "modules/kit/analytic/front_end_load.hpp"

namespace degs::gbu {
namespace {

class Analytic : public FrontEndModel {
public:
    explicit Analytic(const Config& config)
        : FrontEndModel(config, config.list_buffer.chunks, kMemory), config_(config) {}
    std::vector<std::string> units() const override {
        return {"projection", "sorting", "generation", "blending", "memory"};
    }
    std::unique_ptr<TileClock> clock(const FrameWorkload& frame) const override;
    CoarseTile::Options coarse_options() const override { return {config_.tile_size, 1}; }
    // A tile waits for its slowest row, so that all must be looked at.
    Blocks blocks() const override { return {}; }
    int engines() const override { return config_.engines.count; }
    int sorters() const override { return config_.sorting.count; }
    SortCycles sort_cycles(double entries, double) const override {
        return degs::sort_cycles(config_.sorting, entries, entries, front());
    }
    bool grants_lists() const override { return true; }
    double latency() const override {
        return 4 * memory_latency() + config_.engines.generation_latency +
               config_.engines.row_pe_latency;
    }
    int pes() const override { return config_.pes(); }
    std::optional<EstimateErrors> errors() const override { return EstimateErrors{0, 0.07}; }
    std::vector<cost::Activity> activity(const FrameWorkload&, const PreparationCycles& before,
                                         const TileCycles& tiles) const override {
        Work work;
        work.generating = tiles.busy[kGeneration] * config_.engines.count;
        work.slots = tiles.slots;
        work.keys_moved = tiles.keys;
        work.splats_fetched = tiles.fetched;
        work.entries_moved = 2 * tiles.counts[kEntries];
        work.lookups = config_.cache_records() == 0 ? 0 : tiles.fetched;
        std::vector<cost::Activity> all = config_.activity(work);
        for (const cost::Activity& each : front().activity(before, tiles)) {
            all.push_back(each);
        }
        all.push_back(pixel_activity(tiles, config_.pixel_bytes()));
        return all;
    }

    enum Count : std::size_t { kEntries };
    enum Unit : std::size_t { kGeneration = kArrayUnits, kBlending, kMemory };
    const Config& config() const { return config_; }

private:
    Config config_;
};

/// An engine: rows of a splat enter their queues as fast as Row Generation solves them, each when
/// its queue has room.
class Clock : public TileClock {
public:
    explicit Clock(const Analytic& model)
        : model_(model), engines_(model.config().engines), pes_(engines_.row_pes) {}
    void begin(const CoarseTile& tile) override;
    void splat(const CoarseTile& tile) override;
    TileCycles end(const CoarseTile& tile) override;

private:
    struct RowPe {
        double free = 0;
        std::size_t next = 0;       ///< place in the queue
        std::vector<double> loaded; ///< by place: when the entry left it
    };
    /// Cycles in which Row Generation solves `rows` of a splat.
    double cycles_of(double rows) const {
        return engines_.rows_per_cycle == 0 ? 1 : std::max(1.0, rows / engines_.rows_per_cycle);
    }

    const Analytic& model_;
    const Config::Engines& engines_;
    std::vector<RowPe> pes_;
    double generated_ = 0, slots_ = 0, busy_ = 0;
    double entries_ = 0; ///< of the queues of the sampled rows
};

std::unique_ptr<TileClock> Analytic::clock(const FrameWorkload&) const {
    return std::make_unique<Clock>(*this);
}

void Clock::begin(const CoarseTile&) {
    for (RowPe& pe : pes_) {
        pe.free = 0;
        pe.next = 0;
        pe.loaded.assign(engines_.queue_depth, 0);
    }
    generated_ = slots_ = busy_ = entries_ = 0;
}

void Clock::splat(const CoarseTile& tile) {
    double pushed = generated_, solved = 0;
    for (const CoarseSpan& span : tile.spans()) {
        if (!tile.cell_is_live(span.row, 0)) {
            continue;
        }
        solved += tile.row_weight();
        RowPe& pe = pes_[span.row % pes_.size()];
        double& place = pe.loaded[pe.next];
        const double at = std::max(generated_ + cycles_of(solved) - 1, place);
        pe.next = pe.next + 1 == pe.loaded.size() ? 0 : pe.next + 1;
        const double taken = span.length() + (engines_.end_probe ? 1 : 0);
        place = std::max(pe.free, at + 1);
        pe.free = place + taken;
        slots_ += taken;
        entries_ += 1;
        pushed = std::max(pushed, at);
    }
    busy_ += cycles_of(solved);
    generated_ = std::max(pushed, generated_ + cycles_of(solved) - 1) + 1;
}

TileCycles Clock::end(const CoarseTile& tile) {
    double last = generated_;
    for (const RowPe& pe : pes_) {
        last = std::max(last, pe.free);
    }
    TileCycles cycles = model_.front_end_cycles(tile, tile.walked(), last);
    cycles.counts[Analytic::kEntries] = entries_ * tile.row_weight();
    cycles.slots = slots_ * tile.row_weight();
    cycles.busy[Analytic::kGeneration] = busy_ / model_.engines();
    cycles.busy[Analytic::kBlending] = cycles.slots / model_.pes();
    cycles.time = std::max(last, cycles.time);
    return cycles;
}

} // namespace

std::unique_ptr<AnalyticModel> Config::analytic() const {
    return std::make_unique<Analytic>(*this);
}

} // namespace degs::gbu
