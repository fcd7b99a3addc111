// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// The pixel state of the tiles that are rasterised: each has a context of the data path. A context
/// that is free again is given to another tile.
class TileContexts {
public:
    /// `tests`: the PEs test their pixels, see TileRows.
    TileContexts(RenderJob& job, bool tests) : job_(job), tests_(tests) {}

    /// Returns a context whose pixels are those of a new tile.
    int open();
    /// The caller has cleared all rows of the context.
    void close(int context) { free_.push_back(context); }
    /// Rasterises the rows first, first + step, ... last of a splat inside the tile. The splats of
    /// a row must come in depth order.
    void rasterise(int context, const JobTile& tile, std::uint32_t splat, const PixelRange& range,
                   int step, RowOutcome* outcomes);
    void read_row(int context, int row, int count, PixelValue* pixels) const {
        job_.path->read_row(context, row, count, pixels);
    }
    void clear_row(int context, int row) { job_.path->begin_row(context, row); }

private:
    RenderJob& job_;
    bool tests_;
    std::vector<int> free_;
    int contexts_ = 0;
};

} // namespace degs
