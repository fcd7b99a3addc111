// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/functional/row_batch.hpp"

#include <algorithm>

namespace degs {

std::uint32_t RowBatch::splats_of(const JobTile& tile, std::uint32_t index) {
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(kSplats, tile.count - std::uint64_t{index} * kSplats));
}

void RowBatch::rasterise(RenderJob& job, const JobTile& tile, std::uint32_t index,
                         const FunctionalOptions& options, TileContexts& contexts, int context) {
    const std::uint32_t first = index * kSplats;
    const std::uint32_t count = splats_of(tile, index);
    for (std::uint32_t i = 0; i < count; ++i) {
        job.path->expect(tile.splat(first + i));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t splat = tile.splat(first + i);
        const PixelRange rows = sliced_rows(job, tile, splat, options.rows);
        const std::size_t before = outcomes.size();
        splats[i] = {rows, before};
        if (!rows.empty()) {
            outcomes.resize(before + rows.size());
            contexts.rasterise(context, tile, splat, rows, 1, &outcomes[before]);
        }
    }
    takes = count * options.modules;
}

std::int64_t RowBatch::ended_pixels() const {
    std::int64_t ended = 0;
    for (const RowOutcome& row : outcomes) {
        ended += row.ended.count();
    }
    return ended;
}

} // namespace degs
