// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/footprint.hpp"

#include "splat/pixels/tested_pixels.hpp"

namespace degs::gcc {

Footprint::Footprint(int view_size, int side) : side_(side) {
    for (int pixel = 0; pixel < view_size; ++pixel) {
        window_of_.push_back(static_cast<std::uint8_t>(pixel / side));
    }
    const std::size_t windows = window_of_.back() + std::size_t{1};
    valid_.resize(windows, 0);
    for (auto& mask : border_) {
        mask.resize(windows, 0);
    }
}

void Footprint::solve(const DataPath& path, std::uint32_t splat, const JobTile& view) {
    for (int row = first_row_; row <= last_row_; ++row) {
        const std::size_t i = row;
        valid_[i] = 0;
        for (auto& mask : border_) {
            mask[i] = 0;
        }
    }
    rows_.clear();
    each_tested_row(path, splat, view.columns(), view.rows(),
                    [&](int y, const PixelRange& columns) {
                        add({y - view.y, columns.relative_to(view.x)});
                    });
    first_row_ = rows_.empty() ? 0 : window_of(rows_.front().y);
    last_row_ = rows_.empty() ? -1 : window_of(rows_.back().y);
}

void Footprint::add(const Row& row) {
    rows_.push_back(row);
    const int window_row = window_of(row.y);
    const std::size_t i = window_row;
    const int first = window_of(row.columns.first);
    const int last = window_of(row.columns.last);
    const WindowMask windows = windows_between(first, last);
    valid_[i] |= windows;
    if (row.y == window_row * side_) {
        border_[kTop][i] |= windows;
    }
    if (row.y == window_row * side_ + side_ - 1) {
        border_[kBottom][i] |= windows;
    }
    WindowMask left = windows;
    if (row.columns.first != first * side_) {
        left &= ~(WindowMask{1} << first);
    }
    WindowMask right = windows;
    if (row.columns.last != last * side_ + side_ - 1) {
        right &= ~(WindowMask{1} << last);
    }
    border_[kLeft][i] |= left;
    border_[kRight][i] |= right;
}

} // namespace degs::gcc
