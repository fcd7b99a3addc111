// SPDX-License-Identifier: Apache-2.0
// The counters of GCC in the terms that all accelerators share.
#include <algorithm>

#include "base/grouped_number.hpp"
#include "baselines/gcc/engine.hpp"
#include "baselines/gcc/streams.hpp"

namespace degs::gcc {

void Engine::collect(AcceleratorResult& result) const {
    collect_frames(result, job_, image_buffers_, frame_ends_.background());
    result.tiles = finished_tiles();
    result.tiles_cancelled = sum_of(monitors_, &TileMonitor::Stats::tiles_cancelled);
    collect_slots(result);
    if (grouping_) {
        const KeptList<Cycle>& dates = grouping_->frames_grouped();
        for (std::size_t f = dates.first(); f < result.frames.size(); ++f) {
            result.frames[f].preprocessed = dates[f];
        }
    }
    collect_stages(result);
    // Only the ring in front of the array is reported, not the groups on their way to it.
    add_buffer(result, {"group_buffer", "Groups of splats in front of the array."},
               std::int64_t{config_.clusters} * config_.group_buffer_bytes, config_.chunks_ahead(),
               use_of(splat_rings_));
    add_pixel_buffer(result, std::int64_t{config_.clusters} * config_.image_buffer.bytes,
                     config_.tile_contexts(), image_buffers_);
    collect_activity(result);
    streams_.collect(result);
    collect_preparation(result);
    for (std::size_t i = 0; i < projection_.size(); ++i) {
        const Cycle wait = std::max(projection_[i]->memory_wait(), colour_[i]->memory_wait());
        result.waits.splats += ratio_of(wait, projection_.size());
    }
    collect_idle_keys(result);
    collect_laws(result);
    explain(result);
}

// The first task of a frame waits for all of Stage I, and of Stages II and III for the first group
// of each cluster, in which no Gaussian is masked yet.
void Engine::collect_preparation(AcceleratorResult& result) const {
    if (!grouping_) {
        return;
    }
    double first = 0;
    for (const auto& array : arrays_) {
        first += static_cast<double>(
            std::min<std::uint64_t>(config_.projection.group, array->first_entries()));
    }
    const double frames = std::max(1.0, real_of(result.frames.size()));
    const auto share_of = [&](std::uint64_t gaussians) {
        return gaussians == 0 ? 0 : std::min(1.0, first * frames / real_of(gaussians));
    };
    const double listed = share_of(sum_of(projection_, &ProjectionStage::Stats::entries));
    const double projected = share_of(sum_of(projection_, &ProjectionStage::Stats::shapes));
    const double coloured = share_of(sum_of(colour_, &ColourStage::Stats::coloured));
    for (StageUse& stage : result.stages) {
        stage.prepares = stage.name == "projection" ? projected
                         : stage.name == "colour"   ? coloured
                                                    : stage.prepares;
    }
    for (StreamUse& stream : result.streams) {
        stream.prepares = stream.name == kGroupListsRead.name     ? listed
                          : stream.name == kShapes.name           ? projected
                          : stream.name == stream_kinds::kSh.name ? coloured
                                                                  : stream.prepares;
    }
}

void Engine::collect_idle_keys(AcceleratorResult& result) const {
    constexpr double kMatters = 0.2;     // of the cycles of Stage I
    constexpr std::size_t kFewViews = 8; // for each cluster: one that comes late decides
    if (grouping_) {
        const Grouping::Stats& g = grouping_->stats();
        const bool means = real_of(g.busy - g.entry_cycles) > kMatters * real_of(g.busy);
        const bool entries = real_of(g.busy - g.mean_cycles) > kMatters * real_of(g.busy);
        const std::string mean_key = "grouping.means_per_cycle";
        const std::string entry_key = "grouping.entries_per_cycle";
        if (!means) {
            result.idle_keys.push_back(mean_key);
        }
        if (!entries) {
            result.idle_keys.push_back(entry_key);
        }
        if (means || entries) {
            result.idle_keys.push_back(mean_key + " and " + entry_key);
        }
    }
    if (job_.tiles.size() > kFewViews * arrays_.size() * job_.frames.size()) {
        result.idle_keys.emplace_back("view_size");
    }
}

void Engine::collect_slots(AcceleratorResult& result) const {
    add_array_slots(result, arrays_, config_.array.pes());
}

void Engine::collect_stages(AcceleratorResult& result) const {
    if (grouping_) {
        const Grouping::Stats& g = grouping_->stats();
        add_stage(result, {"grouping", "Stage I: groups by depth.", false, 1}, 1, g.busy,
                  counters_of(g));
    }
    if (dispatcher_) {
        const TileDispatcher::Stats& d = dispatcher_->stats();
        add_stage(result, {"dispatch", "The Tile Dispatcher, a cycle for each view."}, 1, d.tiles,
                  counters_of(d));
    }
    if (grouping_) {
        add_stage(result, {"projection", "Stage II: shapes."}, projection_.size(),
                  sum_of(projection_, &ProjectionStage::Stats::busy), Counters().add(projection_));
        Cycle busy = 0;
        for (const auto& stage : colour_) {
            busy += std::max(stage->stats().colour_busy, stage->stats().sort_busy);
        }
        add_stage(result, {"colour", "Stage III: colours and sorting overlap, the busier counts."},
                  colour_.size(), busy, Counters().add(colour_));
    }
    add_stage(result, {"blending", "Stage IV: the window array.", true}, arrays_.size(),
              sum_of(arrays_, &WindowArray::Stats::windows), Counters().add(arrays_));
}

void Engine::collect_laws(AcceleratorResult& result) const {
    using A = WindowArray::Stats;
    const SlotAccount& s = result.slots;
    const std::uint64_t pes = config_.array.pes();
    const std::uint64_t skipped = sum_of(arrays_, &A::skip_cycles) * pes;
    const std::uint64_t taken = sum_of(arrays_, &A::splats) + sum_of(arrays_, &A::splats_dropped);
    auto& laws = result.conservation;
    laws.push_back({"slots of windows and skips = useful + boundary + terminated",
                    sum_of(arrays_, &A::windows) * pes + skipped,
                    s[Slot::Useful] + s[Slot::Boundary] + s[Slot::Terminated]});
    laws.push_back({"valid pixels of live windows = useful + terminated",
                    sum_of(arrays_, &A::valid_pixels) + skipped,
                    s[Slot::Useful] + s[Slot::Terminated]});
    if (dispatcher_) {
        laws.push_back(
            {"views granted = views of the job", dispatcher_->stats().tiles, job_.tiles.size()});
    }
    if (!grouping_) {
        laws.push_back({"splats fetched = rendered + dropped",
                        sum_of(fetchers_, &SplatFetcher::Stats::records), taken});
        return;
    }
    using P = ProjectionStage::Stats;
    using C = ColourStage::Stats;
    const std::uint64_t entries = sum_of(projection_, &P::entries);
    const std::uint64_t shapes = sum_of(projection_, &P::shapes);
    const std::uint64_t coloured = sum_of(colour_, &C::coloured);
    laws.push_back({"entries of the views = read + cancelled", job_.tiles.entries(),
                    entries + sum_of(projection_, &P::entries_cancelled)});
    laws.push_back({"entries read = projected + cancelled", entries,
                    shapes + sum_of(projection_, &P::shapes_cancelled)});
    laws.push_back({"projected = coloured + masked + cancelled", shapes,
                    coloured + sum_of(colour_, &C::masked) + sum_of(colour_, &C::cancelled)});
    laws.push_back({"coloured = rendered + dropped", coloured, taken});
}

void Engine::explain(AcceleratorResult& result) const {
    auto& out = result.left_out;
    explain_tiles(result, sum_of(projection_, &ProjectionStage::Stats::entries_cancelled) +
                              sum_of(fetchers_, &SplatFetcher::Stats::records_cancelled));
    if (grouping_) {
        out.push_back(grouped(sum_of(colour_, &ColourStage::Stats::masked)) +
                      " projected Gaussians could only reach ended blocks: their SH was not read.");
    }
    out.push_back(grouped(sum_of(arrays_, &WindowArray::Stats::windows_ended)) +
                  " windows were passed without evaluation because all their pixels had ended.");
    out.push_back(grouped(sum_of(arrays_, &WindowArray::Stats::splats_dropped)) +
                  " splats reached the array after all pixels of their view had ended and cost no "
                  "slot.");
}

} // namespace degs::gcc
