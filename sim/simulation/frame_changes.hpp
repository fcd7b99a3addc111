// SPDX-License-Identifier: Apache-2.0
// How much the work differs from frame to frame, and how uneven it is; docs/dynamic-scenes.md has
// the formulas.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "splat/frame/frame_source.hpp"

namespace degs::sim {

struct FrameChanges {
    std::optional<double> active_overlap; ///< 0..1; empty if the frames have different Gaussians
    std::optional<double> tile_churn;     ///< 0..1; empty if the frames have different tiles
    double p99_tile_candidates = 0;       ///< splats in a tile's list
    double footprint_gini = 0;            ///< 0..1
};

/// Adds up the changes of frames that come one after the other, of which it keeps the last.
class FrameChangesSum {
public:
    /// `frames`: as many as will be added, at least one.
    explicit FrameChangesSum(std::size_t frames) : frames_(frames) {}
    void add(FramePointer frame);
    /// When all have been added. A single frame has no overlap and no churn.
    FrameChanges changes() const;

private:
    void compare(const FrameWorkload& before, const FrameWorkload& now);
    double p99_list_length() const;

    std::size_t frames_;
    FramePointer before_;
    std::map<std::uint64_t, std::uint64_t> tiles_of_length_; ///< of lists
    std::size_t tiles_ = 0;
    double overlap_ = 0, churned_ = 0, footprint_gini_ = 0;
    bool same_gaussians_ = true, same_tiles_ = true; ///< so far
};

/// "active overlap 0.987 · tile churn 4.6 % · P99 of tile candidates 1.2 k · footprint Gini 0.85";
/// what is missing is left out.
std::string changes_words(const FrameChanges& changes);

} // namespace degs::sim
