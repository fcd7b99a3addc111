// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "splat/frame/pixel_mask.hpp"
#include "splat/pixels/coupled_row.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs {

/// DataPath::rasterise_rows() of any data path, row by row. `Path` is the data path's own class, so
/// that the calls need no table; solved(i, row) is the span of the i-th row, `row` of the tile,
/// without a pixel if its length is 0. It is not asked for if PEs test.
template <class Path, class Solved>
void rasterise_row_by_row(Path& path, const TileRows& rows, const Solved& solved,
                          RowOutcome* outcomes) {
    constexpr int kTasks = 32; // of a BlendTask
    int index = 0;
    for (int row = rows.first; row <= rows.last; row += rows.step, ++outcomes, ++index) {
        RowSpan span = rows.tests ? row_of_box(path, rows.splat, rows.tile_y + row, rows.x_begin,
                                               rows.x_end, rows.tile_y)
                                        .value_or(RowSpan())
                                  : solved(index, row);
        *outcomes = RowOutcome();
        if (!cut(span, rows.image_columns)) {
            continue;
        }
        outcomes->x0 = span.x0;
        outcomes->length = span.length;
        BlendTask task;
        task.g0 = span.g0;
        task.d0 = span.d0;
        task.splat = rows.splat;
        task.row = inside_tile(row);
        task.context = inside_tile(rows.context);
        const int end = span.x0 + span.length;
        for (int column = span.x0 / kTasks * kTasks; column < end; column += kTasks) {
            task.mask = bits_between(std::max(span.x0 - column, 0), std::min(end - column, kTasks));
            task.column = inside_tile(column);
            task.offset = inside_tile(column - span.base);
            const BlendOutcome outcome =
                rows.tests ? path.test(test_of(task, rows.x_begin, rows.tile_y)) : path.blend(task);
            outcomes->inside.put(outcome.useful | outcome.terminated, column);
            outcomes->useful.put(outcome.useful, column);
            outcomes->ended.put(outcome.ended, column);
        }
    }
}

template <class Path>
void rasterise_row_by_row(Path& path, const TileRows& rows, RowOutcome* outcomes) {
    const auto solved = [&](int /*index*/, int row) {
        return path.solve_row(rows.splat, rows.tile_y + row, rows.x_begin, rows.x_end, rows.tile_y)
            .value_or(RowSpan());
    };
    rasterise_row_by_row(path, rows, solved, outcomes);
}

} // namespace degs
