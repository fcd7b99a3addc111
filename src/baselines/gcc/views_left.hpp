// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs::gcc {

/// Tells a stage whether groups still come. All views of the job do, or, if views are granted,
/// those up to an empty last group of kNoTile.
class ViewsLeft {
public:
    ViewsLeft(const RenderJob& job, bool granted) : job_(job), granted_(granted) {}
    bool any() const { return granted_ ? !ended_ : !job_.over(views_); }
    void take(const SplatChunk& group) {
        views_ += group.last ? 1 : 0;
        ended_ = group.tile == kNoTile;
    }

private:
    const RenderJob& job_;
    bool granted_;
    bool ended_ = false;
    TileNumber views_ = 0;
};

} // namespace degs::gcc
