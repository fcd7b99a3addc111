// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "splat/frame/pixel_index.hpp"
#include "splat/frame/projection.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs {

// Rows of splats for an array that checks while it blends (paper, Sec. II-B): nothing is solved, a
// row is as wide as the splat's bounding box, and every pixel tests itself.

/// The image columns (unclipped) of the bounding box of the splat's ellipse.
inline PixelRange columns_of_box(const ProjectedSplat& splat) {
    constexpr double kLimit = 1 << 30;
    const double reach = std::sqrt(splat.q_end() * splat.cov_a);
    return {index_within(std::ceil(splat.mu_x - reach), -kLimit, kLimit),
            index_within(std::floor(splat.mu_x + reach), -kLimit, kLimit)};
}

/// All columns of the splat's bounding box on image row `y`, in place of DataPath::solve_row. Its
/// g0 and d0 mean nothing.
std::optional<RowSpan> row_of_box(const DataPath& path, std::uint32_t splat, int y, int x_begin,
                                  int x_end, int tile_y);

/// The test of the pixels of a task whose tile has its first pixel at (tile_x, tile_y) of the
/// image.
PixelTest test_of(const BlendTask& task, int tile_x, int tile_y);

} // namespace degs
