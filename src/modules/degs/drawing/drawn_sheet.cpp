// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/drawing/drawn_sheet.hpp"

#include <algorithm>

namespace degs {

std::uint32_t DrawnSheet::splats_of(const JobTile& tile, std::uint32_t index) {
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(kSplats, tile.count - std::uint64_t{index} * kSplats));
}

void DrawnSheet::draw(RenderJob& job, const JobTile& tile, std::uint32_t index,
                      const DrawingOptions& options, TileCanvases& canvases, int canvas) {
    const std::uint32_t first = index * kSplats;
    const std::uint32_t count = splats_of(tile, index);
    for (std::uint32_t i = 0; i < count; ++i) {
        job.path->expect(tile.splat(first + i));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t splat = tile.splat(first + i);
        const PixelRange rows = sliced_rows(job, tile, splat, options.rows);
        const std::size_t before = drawn.size();
        splats[i] = {rows, before};
        if (!rows.empty()) {
            drawn.resize(before + rows.size());
            canvases.draw(canvas, tile, splat, rows, 1, &drawn[before]);
        }
    }
    takes = count * options.modules;
}

std::int64_t DrawnSheet::ended_pixels() const {
    std::int64_t ended = 0;
    for (const DrawnRow& row : drawn) {
        ended += row.ended.count();
    }
    return ended;
}

} // namespace degs
