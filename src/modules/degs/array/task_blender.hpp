// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/kit/job/render_job.hpp"
#include "splat/pixels/coupled_row.hpp"

namespace degs {

/// Executes the tasks of a segment as the PEs do: it blends the pixels that a Span Unit has found
/// inside the ellipse or, without span parsing, first tests each of them.
class TaskBlender {
public:
    TaskBlender(RenderJob& job, bool tests) : job_(job), tests_(tests) {}

    BlendOutcome blend(const BlendTask& task, TileNumber tile) const {
        return tests_ ? test(task, job_.tiles[tile]) : job_.path->blend(task);
    }

private:
    BlendOutcome test(const BlendTask& task, const JobTile& tile) const {
        return job_.path->test(test_of(task, tile.x, tile.y));
    }

    RenderJob& job_;
    bool tests_;
};

} // namespace degs
