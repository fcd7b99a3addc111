// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// Where a Pixel Buffer reads finished pixels if a functional model (modules/degs/functional) has
/// them: its contexts of the data path are not those of the timed blocks.
class PixelSource {
public:
    PixelSource() = default;
    PixelSource(const PixelSource&) = delete;
    PixelSource& operator=(const PixelSource&) = delete;
    virtual ~PixelSource() = default;

    /// Reads the first `count` pixels of a row whose splats have all been blended, or whose tile
    /// has ended.
    virtual void read_row(TileNumber number, int row, int count, PixelValue* pixels) = 0;
    /// Tells that the row has been read out, so that its memory is free. Rows of a tile outside the
    /// image are cleared, too.
    virtual void clear_row(TileNumber number, int row) = 0;
};

} // namespace degs
