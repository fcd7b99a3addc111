// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace degs {

/// Where the rows of all tile contexts lie in the pixel planes. A row gets its pixels when it is
/// first updated and gives them back when it begins anew, so that the host holds the rows in use,
/// however many contexts a Pixel Buffer has.
class PixelRows {
public:
    /// Rows are padded to whole blocks of 32 px, so that a block of lanes never leaves its row.
    PixelRows(int contexts, int tile_size)
        : rows_(tile_size), blocks_((rows_ + kBlock - 1) / kBlock),
          place_(contexts * rows_, kNowhere) {}

    /// Room for as many contexts at least.
    void hold(int contexts) { place_.resize(std::max(place_.size(), contexts * rows_), kNowhere); }
    int rows() const { return static_cast<int>(rows_); }
    std::size_t stride() const { return blocks_ * kBlock; }
    /// The row has pixels; first_pixel() may be asked.
    bool placed(int context, int row) const { return place_[index(context, row)] != kNowhere; }
    std::size_t first_pixel(int context, int row) const {
        return place_[index(context, row)] * kBlock;
    }
    /// The first pixel of a row that is about to be updated. A row without pixels gets some, which
    /// may have been another row's and are made ready by `planes.clear(first, count)`.
    template <class Planes>
    std::size_t ready(int context, int row, Planes& planes) {
        const std::uint32_t place = place_[index(context, row)];
        return place != kNowhere ? place * kBlock : fresh(context, row, planes);
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
    static constexpr std::size_t kBlock = 32;

    std::size_t index(int context, int row) const { return context * rows_ + row; }
    // Apart from ready(), which is called for every update: one in hundreds comes here.
    template <class Planes>
    [[gnu::noinline]] std::size_t fresh(int context, int row, Planes& planes) {
        std::uint32_t& place = place_[index(context, row)];
        if (free_.empty()) {
            place = placed_;
            placed_ += static_cast<std::uint32_t>(blocks_);
        } else {
            place = free_.back();
            free_.pop_back();
        }
        planes.clear(place * kBlock, stride());
        return place * kBlock;
    }

    std::size_t rows_, blocks_;
    std::vector<std::uint32_t> place_; // by context and row, in blocks of the planes
    std::vector<std::uint32_t> free_;
    std::uint32_t placed_ = 0; // blocks
};

} // namespace degs
