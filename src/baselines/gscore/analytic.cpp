// SPDX-License-Identifier: Apache-2.0
// GSCore without simulation: its array takes a slot per sub-tile that a splat's box meets and that
// is not done. See docs/analytic.md.
#include <algorithm>
#include <vector>

#include "baselines/gscore/config.hpp"
#include "modules/kit/analytic/front_end_load.hpp"
#include "splat/frame/subtile_cover.hpp"

namespace degs::gscore {
namespace {

class Analytic : public FrontEndModel {
public:
    explicit Analytic(const Config& config)
        : FrontEndModel(config, config.splat_chunks(), kMemory), config_(config) {}
    std::vector<std::string> units() const override {
        return {"projection", "sorting", "blending", "memory"};
    }
    std::unique_ptr<TileClock> clock(const FrameWorkload& frame) const override;
    CoarseTile::Options coarse_options() const override {
        return {config_.array.side(), config_.array.side()};
    }
    // Rows only tell when a sub-tile is done; two of each are enough.
    Blocks blocks() const override { return {1, config_.array.side() / 2}; }
    double visits_per_entry() const override { return 3; } // sub-tiles of a splat
    int engines() const override { return config_.clusters; }
    int sorters() const override { return config_.sorting.count; }
    SortCycles sort_cycles(double entries, double walked) const override {
        // Lists that are granted have been sorted to their end.
        return degs::sort_cycles(config_.sorting, entries, grants_lists() ? entries : walked,
                                 front());
    }
    double latency() const override { return 4 * memory_latency() + config_.array.pipeline_cycles; }
    int pes() const override { return config_.pes(); }
    std::optional<EstimateErrors> errors() const override { return EstimateErrors{0.015, 0.085}; }
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
    Clock(const Analytic& model, const FrameWorkload& frame)
        : model_(model), frame_(frame), grid_(frame.tile_size, model.config().array.side()),
          boxes_(kBoxes) {}
    void begin(const CoarseTile& tile) override {
        passes_ = scans_ = 0;
        passed_over_ = 0;
        inside_ = grid_.holding(tile.columns(), tile.pixel_rows());
        live_ = live(tile);
        changes_ = tile.cell_changes();
    }
    void splat(const CoarseTile& tile) override;
    TileCycles end(const CoarseTile& tile) override;

private:
    SubtileMask live(const CoarseTile& tile) const;
    SubtileMask named(const CoarseTile& tile, SubtileMask among);
    const OrientedBox& box_of(std::uint32_t splat);

    /// Neighbouring tiles list the same splats: so many boxes are kept.
    static constexpr std::size_t kBoxes = 1024;
    struct Box {
        std::uint32_t splat = ~0U;
        OrientedBox box;
    };

    const Analytic& model_;
    const FrameWorkload& frame_;
    SubtileGrid grid_;
    SubtileMask inside_ = 0;
    SubtileMask live_ = 0; ///< after cell_changes_ of the tile's cells
    std::uint64_t changes_ = 0;
    std::vector<Box> boxes_; ///< by splat modulo their number
    double passes_ = 0;      ///< cycles with a slot
    double scans_ = 0;       ///< cycles that only pass over splats without one
    int passed_over_ = 0;
};

std::unique_ptr<TileClock> Analytic::clock(const FrameWorkload& frame) const {
    return std::make_unique<Clock>(*this, frame);
}

/// Sub-tiles with a pixel that has not ended.
SubtileMask Clock::live(const CoarseTile& tile) const {
    SubtileMask mask = 0;
    for (int row = 0, s = 0; row < grid_.per_side(); ++row) {
        for (int column = 0; column < grid_.per_side(); ++column, ++s) {
            const int side = grid_.side();
            const SubtileMask bit = SubtileMask{1} << s;
            mask |= (inside_ & bit) != 0 && tile.cell_is_live(row * side, column * side) ? bit : 0;
        }
    }
    return mask;
}

const OrientedBox& Clock::box_of(std::uint32_t splat) {
    Box& place = boxes_[splat % kBoxes];
    if (place.splat != splat) {
        place = {splat, OrientedBox(frame_.splats[splat])};
    }
    return place.box;
}

/// Sub-tiles of `among` that the solved splat touches.
SubtileMask Clock::named(const CoarseTile& tile, SubtileMask among) {
    switch (model_.config().array.subtile_skip) {
    case SubtileTest::Obb:
        return grid_.meeting(box_of(tile.splat()), tile.x(), tile.y(), among);
    case SubtileTest::Exact: {
        SubtileMask mask = 0;
        for (int row = tile.first_row(); row <= tile.last_row(); ++row) { // sampled or not
            const CoarseSpan span = tile.span_of(row);
            mask |= span.length() > 0 ? grid_.of_pixels(row, {span.first, span.last}) : 0;
        }
        return mask & among;
    }
    default:
        return among;
    }
}

void Clock::splat(const CoarseTile& tile) {
    if (changes_ != tile.cell_changes()) {
        changes_ = tile.cell_changes();
        live_ = live(tile);
    }
    const int subtiles = __builtin_popcount(named(tile, live_));
    passes_ += subtiles;
    const int rate = model_.config().array.skips_per_cycle;
    passed_over_ = subtiles != 0 ? 0 : passed_over_ + 1;
    if (rate != 0 && passed_over_ == rate) {
        passed_over_ = 0;
        scans_ += 1;
    }
}

TileCycles Clock::end(const CoarseTile& tile) {
    TileCycles cycles = model_.front_end_cycles(tile, tile.walked(), passes_ + scans_);
    cycles.slots = passes_ * model_.config().array.lanes;
    cycles.busy[Analytic::kBlending] = (passes_ + scans_) / model_.engines();
    cycles.time = std::max(passes_ + scans_, cycles.time);
    return cycles;
}

} // namespace

std::unique_ptr<AnalyticModel> Config::analytic() const {
    return std::make_unique<Analytic>(*this);
}

} // namespace degs::gscore
