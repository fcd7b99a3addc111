// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/kit/job/render_job.hpp"
#include "splat/pixels/tested_pixels.hpp"

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
    /// wider than the ellipse for rounding, and as wide as a number set's rounding makes it.
    bool reaches(const DataPath& path, std::uint32_t splat, const JobTile& view) const {
        PixelRange rows = path.rows(splat).widened(1).within(view.rows());
        PixelRange columns = path.columns(splat).within(view.columns());
        if (path.rounds_coarsely()) {
            each_tested_row(path, splat, view.columns(), view.rows(),
                            [&](int y, const PixelRange& tested) {
                                rows = rows.joined({y, y});
                                columns = columns.joined(tested);
                            });
        }
        if (rows.empty() || columns.empty()) {
            return false;
        }
        rows = rows.relative_to(view.y);
        columns = columns.relative_to(view.x);
        const std::uint64_t below = ((std::uint64_t{2} << columns.last / block_) - 1) &
                                    ~((std::uint64_t{1} << columns.first / block_) - 1);
        std::uint64_t met = 0;
        for (int row = rows.first / block_; row <= rows.last / block_; ++row) {
            met |= live_[row] & below;
        }
        return met != 0;
    }

private:
    int block_;
    std::vector<std::uint64_t> live_; // per row of blocks
};

} // namespace degs::gcc
