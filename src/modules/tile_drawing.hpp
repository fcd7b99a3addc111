// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/messages.hpp"
#include "modules/render_job.hpp"

namespace degs {

/// Draws tiles ahead of time, in exact mode. Which splat a pixel takes depends on the order of the splats in
/// its row alone, and no block changes that order: queues, conflicts and terminations decide when a task
/// executes, and how many tasks of ended pixels do. So a splat's rows are solved and blended as soon as it is
/// sliced, and the blocks behind carry masks that say what becomes of each task. In strict mode, where tasks
/// are blended when they execute, reports and images are the same.
///
/// A tile has a canvas, which is a context of the data path, from its first splat until it has been read out.
class TileDrawing {
public:
    /// `tests`: the PEs test their pixels, see TileRows.
    TileDrawing(RenderJob& job, bool tests) : job_(job), tests_(tests) {}
    TileDrawing(const TileDrawing&) = delete;
    TileDrawing& operator=(const TileDrawing&) = delete;

    /// Draws the rows first, first + step, ... last of a splat inside the tile. The splats of a row come in
    /// depth order.
    void draw(TileNumber number, std::uint32_t splat, const PixelRange& range, int step,
              DrawnRow* rows);
    int canvas(TileNumber number);
    /// The row has been read out. A row may be outside of the image.
    void clear_row(TileNumber number, int row);
    /// Pixels updated.
    std::uint64_t fragments() const { return fragments_; }

private:
    static constexpr int kNone = -1;
    int open(TileNumber number);

    RenderJob& job_;
    bool tests_;
    std::vector<int> canvases_; // by tile, or kNone
    std::vector<int> cleared_;  // rows, by canvas
    std::vector<int> free_;     // canvases
    std::uint64_t fragments_ = 0;
};

} // namespace degs
