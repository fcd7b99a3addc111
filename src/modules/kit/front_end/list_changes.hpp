// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/kit/job/render_job.hpp"

namespace degs {

/// The entries of each frame's tile lists that are written for it: all, or only those of Gaussians
/// that the tile did not list in the frame before, if lists are kept from frame to frame. Lists are
/// kept between frames of one scene and one size, of each view by itself if views are read
/// together.
class ListChanges {
public:
    ListChanges(const RenderJob& job, bool lists_are_kept)
        : job_(job), lists_are_kept_(lists_are_kept) {}

    bool lists_are_kept() const { return lists_are_kept_; }
    /// Entries of a tile of the job that are written.
    std::uint64_t written(const JobTile& tile) {
        return lists_are_kept_ ? of_frame(tile.frame).per_tile[grid_index(tile)] : tile.count;
    }
    /// Sets, for each entry of the frame's tile_splats, whether it is written.
    void mark(std::uint32_t frame, std::vector<bool>& written);

private:
    struct Frame {
        std::vector<std::uint32_t> per_tile; ///< of the whole grid
    };
    const Frame& of_frame(std::uint32_t frame);
    Frame count(std::uint32_t frame);
    std::size_t grid_index(const JobTile& tile) const;
    bool keeps(std::uint32_t frame) const;

    const RenderJob& job_;
    bool lists_are_kept_;
    KeptList<Frame> frames_; // empty for frames that nobody has asked for
};

} // namespace degs
