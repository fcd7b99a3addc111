// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "splat/model/camera.hpp"
#include "splat/model/pixel_box.hpp"

namespace degs {

/// The square tiles that hold an image. They are those of the camera's raster, which begins with a
/// whole tile; the raster's last column and row of tiles may be partial. The image may begin and
/// end inside a tile. Such a tile lists and solves what it would in the whole raster, and draws the
/// pixels of the image.
///
/// Tiles whose pixels of the image all lie in the hole of the camera are *hidden*: they list
/// nothing, and nobody draws or writes them. A tile that only meets the hole is drawn like any
/// other, so that the hole needs no alignment.
class TileGrid {
public:
    TileGrid(const Camera& camera, int tile_size)
        : TileGrid(camera.window(), camera.raster(), tile_size) {
        hide(camera.hole);
    }
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
    PixelBox image_pixels_of(int tile) const { return pixels_of(tile).within(image_); }

    /// The columns and rows of hidden tiles, counted from the first tile; empty if there are none.
    const PixelBox& hidden() const { return hidden_; }
    bool is_hidden(int tile) const { return hidden_.holds(tile % tiles_x_, tile / tiles_x_); }
    /// Tiles that are not hidden, and pixels of the image in them.
    std::uint64_t shown_tiles() const {
        return std::uint64_t{1} * tiles_x_ * tiles_y_ - area(hidden_);
    }
    std::uint64_t shown_pixels() const {
        return area(image_) - (hidden_.empty() ? 0 : area(hidden_pixels()));
    }

private:
    static std::uint64_t area(const PixelBox& box) {
        return std::uint64_t{1} * box.width() * box.height();
    }
    PixelBox hidden_pixels() const {
        const PixelBox first = image_pixels_of(hidden_.y0 * tiles_x_ + hidden_.x0);
        const PixelBox last = image_pixels_of(hidden_.y1 * tiles_x_ + hidden_.x1);
        return {first.x0, first.y0, last.x1, last.y1};
    }
    void hide(const PixelBox& hole) {
        const PixelBox part = hole.within(image_);
        if (part.empty()) {
            return;
        }
        // A side that reaches the image's end hides its last tile, however much of that is inside.
        const auto first = [this](int from, int image_from) {
            return from == image_from ? from / tile_size_ : (from + tile_size_ - 1) / tile_size_;
        };
        const auto last = [this](int to, int image_to) {
            return to == image_to ? to / tile_size_ : (to + 1) / tile_size_ - 1;
        };
        const PixelBox tiles{first(part.x0, image_.x0), first(part.y0, image_.y0),
                             last(part.x1, image_.x1), last(part.y1, image_.y1)};
        hidden_ = tiles.empty() ? PixelBox() : tiles.relative_to(first_column_, first_row_);
    }

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
    PixelBox hidden_;
};

} // namespace degs
