// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/functional/functional_model.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "base/parallel.hpp"
#include "modules/degs/functional/functional_cache.hpp"
#include "modules/degs/functional/functional_thread.hpp"
#include "modules/degs/functional/tile_contexts.hpp"

namespace degs {
namespace {

/// Rasterises a splat when it is taken.
class OnDemandModel final : public FunctionalModel {
public:
    OnDemandModel(RenderJob& job, const FunctionalOptions& options)
        : job_(job), options_(options), contexts_(job, options.tests) {}

    void expect(const SplatChunk& chunk) override { expect_listed(job_, chunk); }

    PixelRange rows(TileNumber number, std::uint32_t place) override {
        const JobTile& tile = job_.tiles[number];
        return sliced_rows(job_, tile, tile.splat(place), options_.rows);
    }

    void take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
              RowOutcome* outcomes) override {
        if (own.empty()) {
            return;
        }
        const JobTile& tile = job_.tiles[number];
        contexts_.rasterise(context(number), tile, tile.splat(place), own, step, outcomes);
        for (int row = own.first; row <= own.last; row += step, ++outcomes) {
            count(*outcomes);
        }
    }

    void read_row(TileNumber number, int row, int count, PixelValue* pixels) override {
        contexts_.read_row(context(number), row, count, pixels);
    }

    void clear_row(TileNumber number, int row) override {
        const int place = context(number);
        contexts_.clear_row(place, row);
        Place& tile = places_[number];
        if (++tile.cleared == job_.tile_size) {
            contexts_.close(place);
            tile.context = kNone;
        }
    }

private:
    static constexpr int kNone = -1;

    struct Place {
        int context = kNone;
        int cleared = 0; // rows
    };

    int context(TileNumber number) {
        return number < places_.size() && places_[number].context != kNone ? places_[number].context
                                                                           : open(number);
    }
    int open(TileNumber number) {
        while (number >= places_.size()) {
            places_.emplace_back();
        }
        places_.drop_before(job_.tiles.first());
        places_[number] = {contexts_.open(), 0};
        return places_[number].context;
    }

    RenderJob& job_;
    FunctionalOptions options_;
    TileContexts contexts_;
    KeptList<Place> places_; // by tile
};

} // namespace

std::unique_ptr<FunctionalModel>
make_functional_model(RenderJob& job, const FunctionalOptions& options, const KeptTiles& kept) {
    if (kept.bytes != nullptr) {
        return std::make_unique<FunctionalCache>(job, options, kept.pixels, *kept.bytes);
    }
    // A platform keeps no results; its processes do not expect a thread of ours.
    if (host_threads() > 1 && job.keeps_results) {
        try {
            return std::make_unique<FunctionalThread>(job, options);
        } catch (const std::system_error&) {
            // The system gives no thread: it is only slower without.
        }
    }
    return std::make_unique<OnDemandModel>(job, options);
}

} // namespace degs
