// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/expected_work.hpp"

#include <algorithm>
#include <memory>

#include "base/parallel.hpp"

namespace degs {
namespace {

/// Entries of lists, and rows of splats, that are looked at: some 20 ns each.
constexpr double kMostVisits = 3e5;
/// In a frame of so many tiles rows may lie twice as far apart as a model allows for an estimate of
/// its own: a fit to what is simulated takes out the bias, and the tiles that the larger scatter
/// costs are few of many (docs/sampling.md).
constexpr std::size_t kManyTiles = 3000;
/// Tiles that a worker takes at a time; a clock starts afresh with them.
constexpr std::size_t kRun = 128;

/// How many blocks of rows there are for each one that is sampled.
int blocks_apart(const FrameWorkload& frame, const AnalyticModel::Blocks& blocks,
                 const EntrySizes& sizes, std::size_t tiles) {
    const auto entries = static_cast<double>(frame.tile_pairs());
    const int most =
        std::max(blocks.most_apart * (tiles >= kManyTiles ? 2 : 1), blocks.most_fitted);
    int apart = 1;
    while (entries * (1 + sizes.visits / apart) > kMostVisits && 2 * apart <= most) {
        apart *= 2;
    }
    return apart;
}

TileWork work_of(CoarseTile& tile, TileClock* clock) {
    TileWork work = kNoWork;
    work.tiles = 1;
    if (clock != nullptr) {
        clock->begin(tile);
    }
    while (tile.next()) {
        if (clock != nullptr) {
            clock->splat(tile);
        }
        for (const CoarseSpan& span : tile.spans()) {
            if (tile.row_is_live(span.row)) {
                work.rows += 1;
                work.tasks += span.length();
            }
        }
        tile.blend();
    }
    work.rows *= tile.row_weight();
    work.tasks *= tile.row_weight();
    work.pixels = tile.pixels();
    work.entries = tile.entries();
    work.walked = tile.walked();
    work.fragments = tile.fragments();
    work.cycles = clock != nullptr ? clock->end(tile).time : 0;
    return work;
}

} // namespace

std::vector<TileWork> expected_work(const FrameWorkload& frame, const AnalyticModel* model,
                                    TileOrder order) {
    const std::vector<int> listed = listed_tiles(frame, order);
    const AnalyticModel::Blocks blocks =
        model != nullptr ? model->blocks() : AnalyticModel::Blocks{1, 16, 1};
    const int apart = blocks_apart(frame, blocks, entry_sizes(frame, blocks.step), listed.size());
    std::vector<TileWork> work(listed.size());
    parallel_blocks((listed.size() + kRun - 1) / kRun, [&](std::size_t run, std::size_t) {
        CoarseTile tile(frame, model != nullptr ? model->coarse_options() : CoarseTile::Options());
        const std::unique_ptr<TileClock> clock =
            model != nullptr ? model->clock(frame) : std::unique_ptr<TileClock>();
        const std::size_t end = std::min(listed.size(), (run + 1) * kRun);
        for (std::size_t t = run * kRun; t < end; ++t) {
            tile.begin(listed[t],
                       {blocks.height, apart, static_cast<int>(t) * 5 % apart, blocks.step});
            work[t] = work_of(tile, clock.get());
        }
    });
    return work;
}

} // namespace degs
