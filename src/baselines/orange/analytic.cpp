// SPDX-License-Identifier: Apache-2.0
// ORANGE without simulation: batches go to and fro between the vector unit and the array, and a
// tile is left after the batch in which its pixels end. See docs/analytic.md.
#include <algorithm>
#include <cmath>

#include "baselines/orange/batch_dates.hpp"
#include "baselines/orange/config.hpp"
#include "modules/kit/analytic/front_end_load.hpp"

namespace degs::orange {
namespace {

class Analytic : public FrontEndModel {
public:
    explicit Analytic(const Config& config)
        : FrontEndModel(config, config.scratchpad.splat_batches, kMemory), config_(config) {}
    std::vector<std::string> units() const override {
        return {"projection", "sorting", "systolic_arrays", "vector_units", "memory"};
    }
    std::unique_ptr<TileClock> clock(const FrameWorkload& frame) const override;
    CoarseTile::Options coarse_options() const override {
        return {config_.tile_size, config_.tile_size};
    }
    // Rows only tell when the tile has ended.
    Blocks blocks() const override { return {1, std::max(1, config_.tile_size / 2)}; }
    int engines() const override { return config_.cores.count; }
    int sorters() const override { return config_.sorting.count; }
    SortCycles sort_cycles(double entries, double) const override {
        return degs::sort_cycles(config_.sorting, entries, entries, front());
    }
    bool grants_lists() const override { return true; }
    double latency() const override {
        const int batch = config_.fetching.chunk;
        return 4 * memory_latency() + config_.cores.vector.latency_cycles +
               double(config_.cores.array.cycles(batch, config_.tile_area())) +
               double(config_.cores.vector.blend_cycles(std::uint64_t{1} * batch *
                                                        config_.tile_area()));
    }
    int pes() const override { return config_.pes(); }
    std::optional<EstimateErrors> errors() const override { return EstimateErrors{0.035, 0.055}; }
    std::vector<cost::Activity> activity(const FrameWorkload&, const PreparationCycles& before,
                                         const TileCycles& tiles) const override {
        Work work;
        work.slots = tiles.slots;
        work.formed = work.blended = tiles.walked;
        work.keys_moved = tiles.keys;
        std::vector<cost::Activity> all = config_.activity(work);
        for (const cost::Activity& each : front().activity(before, tiles)) {
            all.push_back(each);
        }
        all.push_back(pixel_activity(tiles, config_.pixel_bytes(), kGemmDepth));
        return all;
    }

    enum Unit : std::size_t { kArray = kArrayUnits, kVector, kMemory };
    const Config& config() const { return config_; }

private:
    Config config_;
};

class Clock : public TileClock {
public:
    explicit Clock(const Analytic& model) : model_(model), core_(model.config()) {}
    void begin(const CoarseTile&) override {}
    void splat(const CoarseTile&) override {}
    TileCycles end(const CoarseTile& tile) override;

private:
    const Analytic& model_;
    BatchDates core_;
};

std::unique_ptr<TileClock> Analytic::clock(const FrameWorkload&) const {
    return std::make_unique<Clock>(*this);
}

TileCycles Clock::end(const CoarseTile& tile) {
    const Config& config = model_.config();
    const VectorUnit::Config& vector = config.cores.vector;
    const double entries = tile.entries();
    const double batch = config.fetching.chunk;
    const double seen = vector.termination == Termination::None ? entries : tile.walked();
    const double batches = std::ceil(seen / batch);
    const double blended = std::min(entries, batches * batch);
    const auto of_batches = [&](double splats, const auto& cycles) {
        const double whole = std::floor(splats / batch);
        return whole * double(cycles(config.fetching.chunk)) +
               double(cycles(int(std::lround(splats - whole * batch))));
    };
    const BatchDates::Tile core =
        core_.tile(static_cast<std::size_t>(entries), static_cast<std::size_t>(batches));
    TileCycles cycles = model_.front_end_cycles(tile, core.formed, core.cycles);
    cycles.slots = core.formed * config.tile_area() * kGemmDepth;
    cycles.fragments *= kGemmDepth;
    cycles.busy[Analytic::kArray] =
        of_batches(
            core.formed,
            [&](int splats) { return config.cores.array.cycles(splats, config.tile_area()); }) /
        model_.engines();
    cycles.busy[Analytic::kVector] =
        of_batches(blended,
                   [&](int splats) {
                       return vector.coefficient_cycles(splats) +
                              vector.blend_cycles(std::uint64_t{1} * splats * config.tile_area());
                   }) /
        model_.engines();
    cycles.time = std::max(core.cycles, cycles.time);
    return cycles;
}

} // namespace

std::unique_ptr<AnalyticModel> Config::analytic() const {
    return std::make_unique<Analytic>(*this);
}

} // namespace degs::orange
