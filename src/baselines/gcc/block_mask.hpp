// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/render_job.hpp"

namespace degs::gcc {

/// The transmittance mask of GCC: which blocks of a view still have a pixel that takes splats.
class BlockMask {
public:
    static constexpr int kMaxBlocks = 64; ///< in a row of blocks

    /// Views of up to `view_size` px, at most kMaxBlocks * block.
    BlockMask(int view_size, int block)
        : block_(block), live_((view_size + block - 1) / block, 0) {}

    /// Starts a view none of whose pixels has ended.
    void begin() { std::fill(live_.begin(), live_.end(), ~std::uint64_t{0}); }
    void end_block(int row, int column) { live_[row] &= ~(std::uint64_t{1} << column); }
    /// True if, inside the view, a live block meets the bounding box of the splat, which is a pixel
    /// wider than the ellipse for rounding.
    bool reaches(const DataPath& path, std::uint32_t splat, const JobTile& view) const {
        int top = 0, bottom = 0, left = 0, right = 0;
        path.rows(splat, top, bottom);
        path.columns(splat, left, right);
        top = std::max(top - 1, view.y) - view.y;
        bottom = std::min(bottom + 1, view.y + view.height - 1) - view.y;
        left = std::max(left, view.x) - view.x;
        right = std::min(right, view.x + view.width - 1) - view.x;
        if (top > bottom || left > right) {
            return false;
        }
        const std::uint64_t below =
            ((std::uint64_t{2} << right / block_) - 1) & ~((std::uint64_t{1} << left / block_) - 1);
        std::uint64_t met = 0;
        for (int row = top / block_; row <= bottom / block_; ++row) {
            met |= live_[row] & below;
        }
        return met != 0;
    }

private:
    int block_;
    std::vector<std::uint64_t> live_; // per row of blocks
};

} // namespace degs::gcc
