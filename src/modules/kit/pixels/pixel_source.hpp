// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// Pixels of tiles that are drawn elsewhere than in the contexts of the data path.
class PixelSource {
public:
    PixelSource() = default;
    PixelSource(const PixelSource&) = delete;
    PixelSource& operator=(const PixelSource&) = delete;
    virtual ~PixelSource() = default;

    /// The first `count` pixels of a row whose splats have all been blended, or whose tile has
    /// ended.
    virtual void read_row(TileNumber number, int row, int count, PixelValue* pixels) = 0;
    /// The row has been read out. A row may be outside of the image.
    virtual void clear_row(TileNumber number, int row) = 0;
};

} // namespace degs
