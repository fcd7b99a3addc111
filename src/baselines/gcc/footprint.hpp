// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/kit/job/render_job.hpp"

namespace degs::gcc {

/// One bit per window of a row of windows, leftmost first.
using WindowMask = std::uint64_t;

/// The mask of the windows first to last.
inline WindowMask windows_between(int first, int last) {
    return ((WindowMask{2} << last) - 1) & ~((WindowMask{1} << first) - 1);
}

/// The part of a splat inside a view, pixel row by pixel row and window by window. A view is cut
/// into windows of `side` x `side` px from its top left corner; a pixel is valid if the alpha test
/// of the data path accepts it (alpha >= 1/255), whether or not it has ended.
class Footprint {
public:
    enum Side { kLeft, kRight, kTop, kBottom };
    static constexpr int kMaxWindows = 64; ///< in a row of windows

    /// The valid pixels of row y, all inside the view.
    struct Row {
        int y = 0;
        PixelRange columns;
    };

    /// The view is `view_size` px wide, at most kMaxWindows * side.
    Footprint(int view_size, int side);

    /// Solves a splat, which replaces the previous one.
    void solve(const DataPath& path, std::uint32_t splat, const JobTile& view);

    /// Rows with valid pixels, top to bottom.
    const std::vector<Row>& rows() const { return rows_; }
    /// Windows of a row of windows that hold a valid pixel.
    WindowMask valid(int row) const { return valid_[row]; }
    /// Windows of a row of windows that hold a valid pixel on the given border.
    WindowMask border(Side side, int row) const { return border_[side][row]; }
    int first_window_row() const { return first_row_; } ///< that may hold a valid pixel
    int last_window_row() const { return last_row_; }   ///< below the first one if there is none
    /// Row or column of windows that a row or column of pixels belongs to.
    int window_of(int pixel) const { return window_of_[pixel]; }
    int side() const { return side_; }

private:
    void add(const Row& row);

    int side_;
    std::vector<std::uint8_t> window_of_;
    std::vector<Row> rows_;
    std::vector<WindowMask> valid_;
    std::array<std::vector<WindowMask>, 4> border_;
    int first_row_ = 0, last_row_ = -1;
};

} // namespace degs::gcc
