// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/kit/job/render_job.hpp"

namespace degs {

/// The tiles whose lists one of several like sorting units makes, in their order; see
/// RenderJob::sorter_of(). It looks ahead to the next one: a frame with fewer tiles than units is
/// made before the unit is there.
class SorterTiles {
public:
    SorterTiles(const RenderJob& job, TileNumber sorter, TileNumber sorters)
        : job_(job), sorter_(sorter), sorters_(sorters) {}

    /// Moves to the next tile; if it may still join, sleeps until it does, and moves the process to
    /// that date. False: there is none.
    bool next(Process& process) {
        return next(process, [](const JobTile&) {});
    }
    /// Moves on as above, and calls `pass` with each tile of another unit on the way.
    template <class Pass>
    bool next(Process& process, const Pass& pass) {
        while (job_.has_tile(process, candidate_)) {
            tile_ = candidate_++;
            if (job_.sorter_of(tile_, sorters_) == sorter_) {
                return true;
            }
            pass(job_.tiles[tile_]);
        }
        return false;
    }
    /// Valid after next().
    TileNumber tile() const { return tile_; }

    /// For those who hear from a predecessor which tile is next. True if there may be another tile
    /// after `passed`.
    bool may_follow() {
        while (job_.lists(candidate_) && job_.sorter_of(candidate_, sorters_) != sorter_) {
            ++candidate_;
        }
        return !job_.over(candidate_);
    }
    void pass(TileNumber tile) { candidate_ = tile + 1; }

private:
    const RenderJob& job_;
    TileNumber sorter_, sorters_;
    TileNumber candidate_ = 0, tile_ = 0;
};

} // namespace degs
