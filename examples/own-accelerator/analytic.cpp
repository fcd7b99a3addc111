// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "config.hpp"
#include "modules/kit/analytic/front_end_load.hpp"

namespace degs::row_sweep {
namespace {

class Analytic : public FrontEndModel {
public:
    explicit Analytic(const Config& config)
        : FrontEndModel(config, config.buffer.chunks, kMemory), config_(config) {}
    std::vector<std::string> units() const override {
        return {"projection", "sorting", "blending", "memory"};
    }
    std::unique_ptr<TileClock> clock(const FrameWorkload& frame) const override;
    CoarseTile::Options coarse_options() const override { return {config_.tile_size, 1}; }
    Blocks blocks() const override { return {1, std::max(1, config_.tile_size / 8)}; }
    int engines() const override { return config_.arrays.count; }
    int sorters() const override { return config_.sorting.count; }
    SortCycles sort_cycles(double entries, double /*walked*/) const override { // handed over whole
        SortCycles sorted = degs::sort_cycles(config_.sorting, entries, entries, front());
        sorted.first = sorted.all;
        return sorted;
    }
    double latency() const override { return 4 * memory_latency() + config_.arrays.latency_cycles; }
    int pes() const override { return config_.pes(); }
    std::vector<cost::Activity> activity(const FrameWorkload&, const PreparationCycles& before,
                                         const TileCycles& tiles) const override {
        std::vector<cost::Activity> all = front().activity(before, tiles);
        all.push_back({"blending", tiles.slots});
        all.push_back({"gaussian_buffer", 2 * tiles.fetched * config_.traffic.splat_bytes +
                                              tiles.keys * config_.traffic.list_entry_bytes});
        all.push_back(pixel_activity(tiles, config_.pixel_bytes()));
        return all;
    }

    enum Unit : std::size_t { kBlending = kArrayUnits, kMemory };
    const Config& config() const { return config_; }

private:
    Config config_;
};

class Clock : public TileClock {
public:
    explicit Clock(const Analytic& model) : model_(model) {}
    void begin(const CoarseTile& /*tile*/) override { rows_ = 0; }
    void splat(const CoarseTile& tile) override {
        const auto takes_slot = [&](const CoarseSpan& span) {
            return !model_.config().arrays.skip_ended || tile.row_is_live(span.row);
        };
        const auto rows = std::count_if(tile.spans().begin(), tile.spans().end(), takes_slot);
        rows_ += std::max(1.0, static_cast<double>(rows) * tile.row_weight());
    }
    TileCycles end(const CoarseTile& tile) override {
        TileCycles cycles = model_.front_end_cycles(tile, tile.walked(), rows_);
        cycles.slots = rows_ * model_.config().tile_size;
        cycles.busy[Analytic::kBlending] = rows_ / model_.engines();
        cycles.time = std::max(rows_, cycles.time);
        return cycles;
    }

private:
    const Analytic& model_;
    double rows_ = 0;
};

std::unique_ptr<TileClock> Analytic::clock(const FrameWorkload& /*frame*/) const {
    return std::make_unique<Clock>(*this);
}

} // namespace

std::unique_ptr<AnalyticModel> Config::analytic() const {
    return std::make_unique<Analytic>(*this);
}

} // namespace degs::row_sweep
