// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/traversal.hpp"

#include <algorithm>

namespace degs::gcc {

Traversal::Traversal(int windows) : seen_(windows, 0) {
    frontier_.reserve(windows * windows);
}

void Traversal::begin(const Footprint& splat, const PixelRange& columns, const PixelRange& rows) {
    splat_ = &splat;
    columns_ = columns;
    rows_ = rows;
    std::fill_n(seen_.begin(), rows.last + 1, WindowMask{0});
    frontier_.clear();
    head_ = 0;
}

void Traversal::push(const Window& window) {
    seen_[window.row] |= WindowMask{1} << window.column;
    frontier_.push_back(window);
}

std::optional<Traversal::Window> Traversal::next() {
    if (head_ == frontier_.size()) {
        return std::nullopt;
    }
    return frontier_[head_++];
}

void Traversal::expand(const Window& window, Cycle known) {
    const auto leads = [&](Footprint::Side side) {
        return (splat_->border(side, window.row) >> window.column & 1U) != 0;
    };
    if (window.column > columns_.first && leads(Footprint::kLeft)) {
        push_new(window.row, window.column - 1, known);
    }
    if (window.column < columns_.last && leads(Footprint::kRight)) {
        push_new(window.row, window.column + 1, known);
    }
    if (window.row > rows_.first && leads(Footprint::kTop)) {
        push_new(window.row - 1, window.column, known);
    }
    if (window.row < rows_.last && leads(Footprint::kBottom)) {
        push_new(window.row + 1, window.column, known);
    }
}

void Traversal::push_new(int row, int column, Cycle known) {
    if ((seen_[row] >> column & 1U) == 0) {
        push({row, column, known});
    }
}

std::optional<Traversal::Window> Traversal::find_missed() const {
    for (int row = splat_->first_window_row(); row <= splat_->last_window_row(); ++row) {
        const WindowMask missed = splat_->valid(row) & ~seen_[row];
        if (missed != 0) {
            return Window{row, __builtin_ctzll(missed)};
        }
    }
    return std::nullopt;
}

} // namespace degs::gcc
