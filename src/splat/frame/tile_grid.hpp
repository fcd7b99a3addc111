// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "splat/model/camera.hpp"
#include "splat/model/pixel_box.hpp"

namespace degs {

/// The square tiles that hold an image. They are those of the camera's raster, which begins with a
/// whole tile; the raster's last column and row of tiles may be partial. The image may begin and
/// end inside a tile. Such a tile lists and solves what it would in the whole raster, and draws the
/// pixels of the image.
class TileGrid {
public:
    TileGrid(const Camera& camera, int tile_size)
        : TileGrid(camera.window(), camera.raster(), tile_size) {}
    /// An image that is the whole raster.
    TileGrid(int width, int height, int tile_size)
        : TileGrid({0, 0, width - 1, height - 1}, {0, 0, width - 1, height - 1}, tile_size) {}

    int tile_size() const { return tile_size_; } ///< px
    int tiles_x() const { return tiles_x_; }
    int tiles_y() const { return tiles_y_; }
    /// The image, and all pixels of its tiles, in the raster.
    const PixelBox& image() const { return image_; }
    const PixelBox& covered() const { return covered_; }
    /// The column and the row of the first tile in the raster.
    int first_column() const { return first_column_; }
    int first_row() const { return first_row_; }

    // Tiles of the image are counted row by row.
    int tile_of_pixel(int x, int y) const {
        return (y / tile_size_ - first_row_) * tiles_x_ + (x / tile_size_ - first_column_);
    }
    /// All pixels of a tile in the raster.
    PixelBox pixels_of(int tile) const {
        const int x = (tile % tiles_x_ + first_column_) * tile_size_;
        const int y = (tile / tiles_x_ + first_row_) * tile_size_;
        return PixelBox{x, y, x + tile_size_ - 1, y + tile_size_ - 1}.within(covered_);
    }
    /// The pixels of a tile in the image.
    PixelBox drawn_of(int tile) const { return pixels_of(tile).within(image_); }

private:
    TileGrid(const PixelBox& image, const PixelBox& raster, int tile_size)
        : tile_size_(tile_size), image_(image), first_column_(image.x0 / tile_size),
          first_row_(image.y0 / tile_size), tiles_x_(image.x1 / tile_size - first_column_ + 1),
          tiles_y_(image.y1 / tile_size - first_row_ + 1),
          covered_(PixelBox{first_column_ * tile_size, first_row_ * tile_size,
                            (first_column_ + tiles_x_) * tile_size - 1,
                            (first_row_ + tiles_y_) * tile_size - 1}
                       .within(raster)) {}

    int tile_size_;
    PixelBox image_;
    int first_column_, first_row_, tiles_x_, tiles_y_;
    PixelBox covered_;
};

} // namespace degs
