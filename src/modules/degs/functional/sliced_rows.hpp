// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// Which rows of a splat are sliced: all that its ellipse meets (paper: y_min .. y_max), or those
/// inside the tile's columns.
enum class SlicedRows { Splat, Tile };

/// A hint that the splats of a chunk will be needed soon.
inline void expect_listed(const RenderJob& job, const SplatChunk& chunk) {
    const JobTile& tile = job.tiles[chunk.tile];
    const auto first = static_cast<std::uint32_t>(chunk.first - tile.first);
    for (std::uint32_t i = 0; i < chunk.count; ++i) {
        job.path->expect(tile.splat(first + i));
    }
}

/// Rows inside the tile; may be empty.
inline PixelRange sliced_rows(const RenderJob& job, const JobTile& tile, std::uint32_t splat,
                              SlicedRows rows) {
    const PixelRange met = rows == SlicedRows::Tile
                               ? job.path->rows_in_columns(splat, tile.x, tile.x + tile.width)
                               : job.path->rows(splat);
    return met.within(tile.rows()).relative_to(tile.y);
}

} // namespace degs
