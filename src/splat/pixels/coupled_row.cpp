// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/coupled_row.hpp"

namespace degs {

std::optional<RowSpan> row_of_box(const DataPath& path, std::uint32_t splat, int y, int x_begin,
                                  int x_end, int tile_y) {
    std::optional<RowSpan> row;
    const PixelRange columns =
        path.box_columns(splat).within({x_begin, x_end - 1}).relative_to(x_begin);
    if (columns.empty()) {
        return row;
    }
    RowSpan& span = row.emplace();
    span.splat = splat;
    span.y = inside_tile(y - tile_y);
    span.x0 = inside_tile(columns.first);
    span.length = inside_tile(columns.size());
    span.base = span.x0;
    return row;
}

PixelTest test_of(const BlendTask& task, int tile_x, int tile_y) {
    PixelTest test;
    test.splat = task.splat;
    test.mask = task.mask;
    test.x = tile_x + task.column;
    test.y = tile_y + task.row;
    test.row = task.row;
    test.column = task.column;
    test.context = task.context;
    return test;
}

} // namespace degs
