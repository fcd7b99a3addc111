// SPDX-License-Identifier: Apache-2.0
// The counters of GCC in the terms that all accelerators share.
#include <algorithm>

#include "baselines/gcc/gcc.hpp"
#include "config/grouped_number.hpp"

namespace degs::gcc {

void Engine::collect(AcceleratorResult& result) const {
    collect_frames(result, image_buffers_, frame_ends_.background());
    result.tiles = finished_tiles();
    result.tiles_cancelled = monitor_->stats().tiles_cancelled;
    result.slots = array_->stats().slots;
    result.window = array_->stats().window;
    if (grouping_) {
        for (std::size_t f = 0; f < result.frames.size(); ++f) {
            result.frames[f].preprocessed = grouping_->frames_grouped()[f];
        }
    }
    collect_stages(result);
    // Only the ring in front of the array is reported, not the groups on their way to it.
    add_buffer(result, {"group_buffer", "Groups of splats in front of the array."},
               config_.group_buffer_bytes, config_.chunks_ahead(), use_of(splat_rings_));
    add_pixel_buffer(result, config_.image_buffer.bytes, config_.tile_contexts(), image_buffers_);
    collect_activity(result);
    streams_.collect(result);
    collect_laws(result);
    explain(result);
}

void Engine::collect_stages(AcceleratorResult& result) const {
    if (grouping_) {
        const Grouping::Stats& g = grouping_->stats();
        add_stage(result, {"grouping", "Stage I: groups by depth."}, 1, g.busy, counters_of(g));
        const ProjectionStage::Stats& p = projection_->stats();
        add_stage(result, {"projection", "Stage II: shapes."}, 1, p.busy, counters_of(p));
        const ColourStage::Stats& c = colour_->stats();
        add_stage(result, {"colour", "Stage III: colours and sorting overlap, the busier counts."},
                  1, std::max(c.colour_busy, c.sort_busy), counters_of(c));
    }
    const WindowArray::Stats& a = array_->stats();
    add_stage(result, {"blending", "Stage IV: the window array."}, 1, a.windows, counters_of(a));
}

void Engine::collect_laws(AcceleratorResult& result) const {
    const WindowArray::Stats& a = array_->stats();
    const SlotAccount& s = a.slots;
    const std::uint64_t pes = config_.pes();
    auto& laws = result.conservation;
    laws.push_back({"slots of windows and skips = useful + boundary + terminated",
                    (a.windows + a.skip_cycles) * pes, s.useful + s.boundary + s.terminated});
    laws.push_back({"valid pixels of live windows = useful + terminated",
                    a.valid_pixels + a.skip_cycles * pes, s.useful + s.terminated});
    if (!grouping_) {
        laws.push_back({"splats fetched = rendered + dropped", fetcher_->stats().records,
                        a.splats + a.splats_dropped});
        return;
    }
    const ProjectionStage::Stats& p = projection_->stats();
    const ColourStage::Stats& c = colour_->stats();
    std::uint64_t view_entries = 0; // of the job, which may be a sample of the views
    for (const JobTile& view : job_.tiles) {
        view_entries += view.count;
    }
    laws.push_back(
        {"entries of the views = read + cancelled", view_entries, p.entries + p.entries_cancelled});
    laws.push_back(
        {"entries read = projected + cancelled", p.entries, p.shapes + p.shapes_cancelled});
    laws.push_back({"projected = coloured + masked + cancelled", p.shapes,
                    c.coloured + c.masked + c.cancelled});
    laws.push_back({"coloured = rendered + dropped", c.coloured, a.splats + a.splats_dropped});
}

void Engine::explain(AcceleratorResult& result) const {
    auto& out = result.left_out;
    explain_tiles(result, grouping_ ? projection_->stats().entries_cancelled
                                    : fetcher_->stats().records_cancelled);
    if (grouping_) {
        out.push_back(grouped(colour_->stats().masked) +
                      " projected Gaussians could only reach ended blocks: their SH was not read.");
    }
    out.push_back(grouped(array_->stats().windows_ended) +
                  " windows were passed without evaluation because all their pixels had ended.");
    out.push_back(grouped(array_->stats().splats_dropped) +
                  " splats reached the array after all pixels of their view had ended and cost no "
                  "slot.");
}

} // namespace degs::gcc
