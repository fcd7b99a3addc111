// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/pixels/data_path.hpp"

namespace degs {

/// Calls visit(y, tested) for every row of the image rows `rows` on which pixels of `columns` pass
/// DataPath::test, downwards; `tested` are their columns.
template <class Visit>
void each_tested_row(const DataPath& path, std::uint32_t splat, const PixelRange& columns,
                     const PixelRange& rows, const Visit& visit) {
    const PixelRange possible = path.tested_rows(splat, columns, rows);
    for (int y = possible.first; y <= possible.last; ++y) {
        const PixelRange tested = path.tested_columns(splat, y, columns.first, columns.last + 1);
        if (!tested.empty()) {
            visit(y, tested);
        }
    }
}

} // namespace degs
