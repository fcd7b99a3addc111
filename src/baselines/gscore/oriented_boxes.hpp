// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/kit/job/render_job.hpp"
#include "splat/frame/subtile_cover.hpp"

namespace degs::gscore {

/// The oriented boxes of a job's splats, made when a frame is first asked for. Shared by all arrays
/// that look at the same frames.
class OrientedBoxes {
public:
    explicit OrientedBoxes(const RenderJob& job) : job_(job) {}
    /// Makes the boxes of all frames up to this one that the job still has.
    void include(std::uint32_t frame) {
        frames_ = std::max(frames_, static_cast<std::uint32_t>(job_.frames.first()));
        for (; frames_ <= frame; ++frames_) {
            std::size_t box = job_.first_splat[frames_];
            const std::vector<ProjectedSplat>& splats = job_.frames[frames_]->splats;
            boxes_.resize(std::max(boxes_.size(), box + splats.size()));
            for (const ProjectedSplat& splat : splats) {
                boxes_[box++] = OrientedBox(splat);
            }
        }
    }
    /// `splat` is a DataPath index.
    const OrientedBox& operator[](std::uint32_t splat) const { return boxes_[splat]; }

private:
    const RenderJob& job_;
    std::vector<OrientedBox> boxes_;
    std::uint32_t frames_ = 0;
};

} // namespace degs::gscore
