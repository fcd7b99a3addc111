// SPDX-License-Identifier: Apache-2.0
// The image of a coupled array, tile by tile from DataPath::test alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "splat/frame/pixel_mask.hpp"
#include "splat/frame/tile_window.hpp"
#include "splat/images/image.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs::test {

/// An image and how many updates made it.
struct BlendedImage {
    Image image;
    std::uint64_t useful = 0;
};

constexpr int kPixelsOfTest = 32; ///< that a PixelTest can name

/// Every pixel of a tile checks every splat of its list for itself.
class CheckedTile {
public:
    CheckedTile(const FrameWorkload& work, const DataPathOptions& numbers)
        : work_(work), path_(make_data_path(numbers, work.tile_size, 1)),
          base_(path_->add_frame(work)), row_(work.tile_size) {}

    void blend(int column, int row, BlendedImage& out) {
        box_ = pixels_of(work_, {column, row, column, row});
        left_ = box_.x0 / work_.tile_size * work_.tile_size;
        top_ = box_.y0 / work_.tile_size * work_.tile_size;
        for (int y = 0; y < work_.tile_size; ++y) {
            path_->begin_row(0, y);
        }
        const std::uint64_t tile = std::uint64_t(row) * work_.tiles_x + column;
        for (auto i = work_.tile_begin[tile]; i < work_.tile_begin[tile + 1]; ++i) {
            out.useful += test(base_ + work_.tile_splats[i]);
        }
        if (work_.tile_begin[tile] != work_.tile_begin[tile + 1]) {
            write(out.image);
        }
    }

private:
    std::uint64_t test(std::uint32_t splat) {
        std::uint64_t useful = 0;
        PixelTest task;
        task.splat = splat;
        for (int y = box_.y0; y <= box_.y1; ++y) {
            for (int x = box_.x0; x <= box_.x1; x += kPixelsOfTest) {
                task.mask = bits_between(0, std::min(kPixelsOfTest, box_.x1 + 1 - x));
                task.x = x;
                task.y = y;
                task.row = static_cast<std::int16_t>(y - top_);
                task.column = static_cast<std::int16_t>(x - left_);
                useful += __builtin_popcount(path_->test(task).useful);
            }
        }
        return useful;
    }
    void write(Image& image) {
        for (int y = box_.y0; y <= box_.y1; ++y) {
            path_->read_row(0, y - top_, box_.x1 - left_ + 1, row_.data());
            for (int x = box_.x0; x <= box_.x1; ++x) {
                const std::size_t at = work_.camera.place_of(x, y);
                const PixelValue& pixel = row_[x - left_];
                for (int channel = 0; channel < 3; ++channel) {
                    image.rgb[3 * at + channel] = static_cast<float>(pixel.rgb[channel]);
                }
                image.transmittance[at] = static_cast<float>(pixel.transmittance);
                image.fragments[at] = pixel.updates;
            }
        }
    }

    const FrameWorkload& work_;
    std::unique_ptr<DataPath> path_;
    std::uint32_t base_;
    std::vector<PixelValue> row_;
    PixelBox box_;           // of the tile's pixels that are in the image
    int left_ = 0, top_ = 0; // where the whole tile begins
};

/// What pixels that check for themselves show, without an accelerator around them. Every image of a
/// coupled array is to be this one, bit by bit.
inline BlendedImage checked_image(const FrameWorkload& work, const DataPathOptions& numbers) {
    BlendedImage expected{Image(work.camera.width, work.camera.height)};
    CheckedTile tile(work, numbers);
    for (int row = 0; row < work.tiles_y; ++row) {
        for (int column = 0; column < work.tiles_x; ++column) {
            tile.blend(column, row, expected);
        }
    }
    return expected;
}

} // namespace degs::test
