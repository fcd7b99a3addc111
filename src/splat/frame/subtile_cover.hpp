// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "splat/frame/pixel_index.hpp"
#include "splat/frame/projection.hpp"

namespace degs {

/// The box along an ellipse's principal axes, half lengths sqrt(Q_th lambda), that GSCore tests
/// instead of the ellipse (shape-aware intersection test).
class OrientedBox {
public:
    OrientedBox() = default;
    explicit OrientedBox(const ProjectedSplat& splat);
    /// True if the box meets the areas (centre +- 0.5) of pixels x .. x + size - 1, y .. y +
    /// size - 1. By separating axes, widened by `pixel_slack`: true for every square with a
    /// pixel inside the ellipse.
    bool meets(double x, double y, double size) const;

private:
    double mu_x_ = 0, mu_y_ = 0;
    double cosine_ = 1, sine_ = 0;     // of the major axis
    double major_ = 0, minor_ = 0;     // half lengths, px
    double reach_x_ = 0, reach_y_ = 0; // half extents along the image axes
};

/// How a design finds the sub-tiles that a splat touches. `Obb`: its oriented box meets the pixels'
/// areas. `Exact`: at least one pixel of the image passes DataPath::test. `None`: all of them.
enum class SubtileTest { Obb, Exact, None };

/// Bit r * per_side + c stands for sub-tile (r, c) of a tile.
using SubtileMask = std::uint32_t;

/// The sub-tiles of one tile: squares of `side` px, `per_side` x `per_side` of them.
class SubtileGrid {
public:
    /// 1 <= (tile_size / side)^2 <= 32, `side` divides `tile_size`.
    SubtileGrid(int tile_size, int side);

    int side() const { return side_; }
    int per_side() const { return per_side_; }
    int count() const { return per_side_ * per_side_; }
    /// Sub-tiles with a pixel among these columns and rows of the tile, which it has.
    SubtileMask holding(const PixelRange& columns, const PixelRange& rows) const;
    /// Sub-tiles of the tile at (x, y) whose areas meet the box.
    SubtileMask meeting(const OrientedBox& box, int x, int y) const {
        return meeting(box, x, y, ~SubtileMask{0});
    }
    /// Sub-tiles of `among` whose areas meet the box.
    SubtileMask meeting(const OrientedBox& box, int x, int y, SubtileMask among) const;
    /// Sub-tiles with a pixel among `columns` of a row of the tile.
    SubtileMask of_pixels(int row, const PixelRange& columns) const;

private:
    int side_, per_side_;
};

} // namespace degs
