// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// The pixels of the tiles that are drawn: each has a canvas, which is a context of the data path.
class TileCanvases {
public:
    /// `tests`: the PEs test their pixels, see TileRows.
    TileCanvases(RenderJob& job, bool tests) : job_(job), tests_(tests) {}

    int open();
    /// All rows of the canvas are cleared already.
    void close(int canvas) { free_.push_back(canvas); }
    /// Draws rows first, first + step, ... last of a splat inside the tile. The splats of a row
    /// come in depth order.
    void draw(int canvas, const JobTile& tile, std::uint32_t splat, const PixelRange& range,
              int step, DrawnRow* rows);
    void read_row(int canvas, int row, int count, PixelValue* pixels) const {
        job_.path->read_row(canvas, row, count, pixels);
    }
    void clear_row(int canvas, int row) { job_.path->begin_row(canvas, row); }

private:
    RenderJob& job_;
    bool tests_;
    std::vector<int> free_;
    int canvases_ = 0;
};

} // namespace degs
