// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "baselines/gcc/footprint.hpp"
#include "tlm/clock_domain.hpp"

namespace degs::gcc {

/// The traversal of GCC from window to window of one splat (rule: docs/gcc-window-array.md). It
/// keeps a frontier of windows and visits them in the order in which they were found. A visited
/// window adds the neighbours across those of its sides on which it has a valid border pixel. The
/// class returns the next window and the date from which it is known; the caller handles dates
/// otherwise.
class Traversal {
public:
    struct Window {
        int row = 0, column = 0;
        Cycle known = 0; ///< date from which it may be visited
    };

    /// Views of at most `windows` x `windows` windows.
    explicit Traversal(int windows);

    /// Starts on these columns and rows of a view's windows. `splat` is to stay as it is until the
    /// end.
    void begin(const Footprint& splat, const PixelRange& columns, const PixelRange& rows);
    /// Adds a window that no border has led to.
    void seed(const Window& window) { push(window); }
    /// Takes the oldest window of the frontier, if there is one.
    std::optional<Window> next();
    /// Adds the neighbours to which the borders of `window` lead and that are new.
    void expand(const Window& window, Cycle known);
    /// First window, row by row, that holds a valid pixel and was never in the frontier.
    std::optional<Window> find_missed() const;

private:
    void push(const Window& window);
    void push_new(int row, int column, Cycle known);

    const Footprint* splat_ = nullptr;
    PixelRange columns_, rows_;    // of windows
    std::vector<WindowMask> seen_; // per row of windows: visited or in the frontier
    std::vector<Window> frontier_; // from head_ on
    std::size_t head_ = 0;
};

} // namespace degs::gcc
