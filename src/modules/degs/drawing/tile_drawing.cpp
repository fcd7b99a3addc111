// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/drawing/tile_drawing.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "base/parallel.hpp"
#include "modules/degs/drawing/drawing_thread.hpp"
#include "modules/degs/drawing/kept_drawing.hpp"
#include "modules/degs/drawing/tile_canvases.hpp"

namespace degs {
namespace {

/// Draws a splat when it is taken.
class DrawingOnDemand final : public TileDrawing {
public:
    DrawingOnDemand(RenderJob& job, const DrawingOptions& options)
        : job_(job), options_(options), canvases_(job, options.tests) {}

    void expect(const SplatChunk& chunk) override { expect_listed(job_, chunk); }

    PixelRange rows(TileNumber number, std::uint32_t place) override {
        const JobTile& tile = job_.tiles[number];
        return sliced_rows(job_, tile, tile.splat(place), options_.rows);
    }

    void take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
              DrawnRow* drawn) override {
        if (own.empty()) {
            return;
        }
        const JobTile& tile = job_.tiles[number];
        canvases_.draw(canvas(number), tile, tile.splat(place), own, step, drawn);
        for (int row = own.first; row <= own.last; row += step, ++drawn) {
            count(*drawn);
        }
    }

    void read_row(TileNumber number, int row, int count, PixelValue* pixels) override {
        canvases_.read_row(canvas(number), row, count, pixels);
    }

    void clear_row(TileNumber number, int row) override {
        const int place = canvas(number);
        canvases_.clear_row(place, row);
        Drawn& tile = drawn_[number];
        if (++tile.cleared == job_.tile_size) {
            canvases_.close(place);
            tile.canvas = kNone;
        }
    }

private:
    static constexpr int kNone = -1;

    struct Drawn {
        int canvas = kNone;
        int cleared = 0; // rows
    };

    int canvas(TileNumber number) {
        return number < drawn_.size() && drawn_[number].canvas != kNone ? drawn_[number].canvas
                                                                        : open(number);
    }
    int open(TileNumber number) {
        while (number >= drawn_.size()) {
            drawn_.emplace_back();
        }
        drawn_.drop_before(job_.tiles.first());
        drawn_[number] = {canvases_.open(), 0};
        return drawn_[number].canvas;
    }

    RenderJob& job_;
    DrawingOptions options_;
    TileCanvases canvases_;
    KeptList<Drawn> drawn_; // by tile
};

} // namespace

std::unique_ptr<TileDrawing> make_tile_drawing(RenderJob& job, const DrawingOptions& options,
                                               const KeptTiles& kept) {
    if (kept.bytes != nullptr) {
        return std::make_unique<KeptDrawing>(job, options, kept.pixels, *kept.bytes);
    }
    // A platform keeps no results; its processes do not expect a thread of ours.
    if (host_threads() > 1 && job.keeps_results) {
        try {
            return std::make_unique<DrawingThread>(job, options);
        } catch (const std::system_error&) {
            // The system gives no thread: it is only slower without.
        }
    }
    return std::make_unique<DrawingOnDemand>(job, options);
}

} // namespace degs
