// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace degs {

/// Where the rows of all tile contexts lie in the pixel planes. A row gets its pixels when it is
/// first updated and gives them back when it begins anew, so that the host holds the rows in use,
/// however many contexts a Pixel Buffer has.
class PixelRows {
public:
    /// Rows are padded to 32 px, so that a block of lanes never leaves its row.
    PixelRows(int contexts, int tile_size)
        : rows_(tile_size), stride_((rows_ + 31) / 32 * 32), place_(contexts * rows_, kNowhere) {}

    std::size_t stride() const { return stride_; }
    /// The row has pixels; first_pixel() may be asked.
    bool placed(int context, int row) const { return place_[index(context, row)] != kNowhere; }
    std::size_t first_pixel(int context, int row) const {
        return place_[index(context, row)] * stride_;
    }
    /// Gives the row pixels; returns the first of them. They may have been another row's.
    std::size_t place(int context, int row) {
        std::uint32_t& place = place_[index(context, row)];
        if (free_.empty()) {
            place = placed_++;
        } else {
            place = free_.back();
            free_.pop_back();
        }
        return place * stride_;
    }
    void release(int context, int row) {
        std::uint32_t& place = place_[index(context, row)];
        if (place != kNowhere) {
            free_.push_back(place);
            place = kNowhere;
        }
    }

private:
    static constexpr std::uint32_t kNowhere = ~std::uint32_t{0};
    std::size_t index(int context, int row) const { return context * rows_ + row; }

    std::size_t rows_, stride_;
    std::vector<std::uint32_t> place_; // by context and row, in rows of the planes
    std::vector<std::uint32_t> free_;
    std::uint32_t placed_ = 0;
};

} // namespace degs
