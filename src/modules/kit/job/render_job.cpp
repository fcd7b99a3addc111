// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/job/render_job.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

namespace degs {

namespace {

// Splats are in depth order, Gaussians are streamed in scene order. Ranks reach from the first
// visible Gaussian to the last one only, so that a few visible ones of a large scene cost little.
std::vector<std::uint64_t> prefix_of_pairs(const FrameWorkload& frame) {
    std::vector<std::uint64_t> prefix(frame.visible_of.size() + 1, 0);
    if (frame.visible_of.empty()) {
        return prefix;
    }
    const std::uint32_t first = frame.visible_of.front();
    std::vector<std::uint32_t> rank(frame.visible_of.back() - first + std::size_t{1}, 0);
    for (std::uint32_t v = 0; v < frame.visible_of.size(); ++v) {
        rank[frame.visible_of[v] - first] = v;
    }
    for (std::size_t s = 0; s < frame.splats.size(); ++s) {
        prefix[rank[frame.splats[s].id - first] + 1] = frame.tiles_touched[s];
    }
    for (std::size_t v = 1; v < prefix.size(); ++v) {
        prefix[v] += prefix[v - 1];
    }
    return prefix;
}

} // namespace

void RenderJob::add_together(std::vector<FramePointer> group,
                             const std::vector<MemoryBases>& base) {
    const Group of_all{static_cast<std::uint32_t>(frames.size()),
                       static_cast<std::uint32_t>(group.size())};
    for (std::size_t v = 0; v < group.size(); ++v) {
        add_view(std::move(group[v]), base.empty() ? MemoryBases() : base[v], of_all);
    }
    ++joined_groups_;
}

void RenderJob::add_view(FramePointer frame, const MemoryBases& base, const Group& group) {
    const std::lock_guard<TurnMutex> lock(*changes);
    const auto f = static_cast<std::uint32_t>(frames.size());
    groups_.push_back(group);
    const FrameWorkload& work = *frame;
    frames.push_back(std::move(frame));
    bases.push_back(base);
    first_splat.push_back(path->add_frame(work));
    pair_prefix.push_back(prefix_of_pairs(work));
    places.emplace_back(work, record_order);
    images.push_back(f < drawn_images ? Image(work.camera.width, work.camera.height) : Image());
    ends_of_frame_.push_back(0);
    const std::vector<int> listed = listed_tiles(work, tile_order);
    const TileGrid grid = work.grid();
    background_tiles += grid.shown_tiles() - listed.size();
    std::uint64_t before = 0;
    for (const int t : listed) {
        const PixelBox whole = grid.pixels_of(t), inside = grid.image_pixels_of(t);
        JobTile tile;
        tile.frame = f;
        tile.x = whole.x0;
        tile.y = whole.y0;
        tile.width = whole.width();
        tile.height = whole.height();
        tile.cut_left = inside.x0 - whole.x0;
        tile.cut_top = inside.y0 - whole.y0;
        tile.cut_right = whole.x1 - inside.x1;
        tile.cut_bottom = whole.y1 - inside.y1;
        tile.first = work.tile_begin[t];
        tile.count = work.tile_begin[t + 1] - tile.first;
        tile.list = work.tile_splats.data() + tile.first;
        tile.first_splat = first_splat[f];
        tile.before = before;
        before += tile.count;
        tiles.push_back(tile);
    }
    tiles_of_frame.push_back(listed.size());
    if (!listed.empty()) {
        tiles.back().last_of_frame = true;
    }
}

bool TileList::retire(std::uint32_t frame) {
    const auto end = std::find_if(tiles_.begin(), tiles_.end(),
                                  [frame](const JobTile& tile) { return tile.frame != frame; });
    if (!std::all_of(tiles_.cbegin(), std::deque<JobTile>::const_iterator(end),
                     [](const JobTile& tile) { return tile.passed; })) {
        return false;
    }
    const auto count = end - tiles_.begin();
    tiles_.erase(tiles_.begin(), end); // at an end of a deque the others stay where they are
    index_.erase(index_.begin(), index_.begin() + count);
    first_ += count;
    return true;
}

bool RenderJob::add_next() {
    std::vector<FramePointer> group;
    while (group.size() < views) {
        group.push_back(source.take());
        if (group.back() == nullptr) {
            return false;
        }
    }
    retire_ended();
    add_together(std::move(group));
    return true;
}

// The last one that has ended stays, with all of its views: others may still look at it, see
// retire_before().
void RenderJob::retire_ended() {
    while (ended_ < frames.size() &&
           ends_of_frame_[ended_] == tiles_of_frame[ended_] * ends.of_tile + ends.of_frame) {
        ++ended_;
    }
    retire_before(static_cast<std::uint32_t>(ended_ - std::min<std::size_t>(ended_, views)));
}

void RenderJob::retire_before(std::uint32_t frame) {
    const std::lock_guard<TurnMutex> lock(*changes);
    std::size_t first = frames.first();
    for (; first < frame && tiles.retire(static_cast<std::uint32_t>(first)); ++first) {
        path->remove_frame(first_splat[first], frames[first]->splats.size());
    }
    frames.drop_before(first);
    first_splat.drop_before(first);
    tiles_of_frame.drop_before(first);
    ends_of_frame_.drop_before(first);
    images.drop_before(first_dated());
    places.drop_before(first);
    pair_prefix.drop_before(first);
    bases.drop_before(first);
    groups_.drop_before(first);
}

std::optional<std::uint32_t> RenderJob::view_before(std::uint32_t frame) const {
    const Group& group = groups_[frame];
    const bool may_be = group.first > first_since_reset;
    return may_be && views_of(group.first - 1) == group.views
               ? std::optional<std::uint32_t>(frame - group.views)
               : std::nullopt;
}

MemoryMap RenderJob::map(std::uint32_t frame, const TrafficConfig& traffic) const {
    MemoryMap map(traffic, *frames[frame], bases[frame]);
    if (!bases[frame].given) {
        for (std::uint32_t before = first_view_of(frame); before < frame; ++before) {
            map.move_behind(traffic, *frames[before]);
        }
    }
    return map;
}

ScatteredRecords RenderJob::splat_records(std::uint32_t frame, const TrafficConfig& traffic,
                                          const std::uint32_t* splats, std::size_t count) const {
    const MemoryMap at = map(frame, traffic);
    ScatteredRecords records;
    records.base = at.splats;
    records.stride = records.bytes = traffic.splat_bytes;
    records.burst = traffic.burst_bytes;
    records.array_bytes = at.lists - at.splats;
    records.numbers = splats;
    records.count = count;
    records.places = places[frame].of_splats();
    return records;
}

// Written as they are: a burst that is not the record's own must not be touched.
ScatteredRecords RenderJob::visible_records(std::uint32_t frame, const TrafficConfig& traffic,
                                            std::uint32_t first, std::size_t count) const {
    ScatteredRecords records =
        splat_records(frame, traffic, places[frame].of_visible() + first, count);
    records.burst = 1;
    records.places = nullptr;
    return records;
}

ScatteredRecords RenderJob::sh_records(std::uint32_t frame, const TrafficConfig& traffic,
                                       const std::uint32_t* gaussians, std::size_t count) const {
    const FrameWorkload& work = *frames[frame];
    const MemoryMap at(traffic, work, bases[frame]); // of the scene, which all views share
    ScatteredRecords records;
    records.base = at.sh;
    records.stride = records.bytes = traffic.sh_size(work.sh_degree);
    records.burst = traffic.burst_bytes;
    records.array_bytes = bases[frame].given ? work.gaussians * records.bytes : at.splats - at.sh;
    records.numbers = gaussians;
    records.count = count;
    return records;
}

RenderJob make_render_job(const DataPathOptions& options, int tile_size, int contexts,
                          RecordOrder records, TileOrder tiles) {
    RenderJob job;
    job.record_order = records;
    job.tile_order = tiles;
    job.tile_size = tile_size;
    job.path = make_data_path(options, tile_size, contexts);
    return job;
}

RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const DataPathOptions& options, int contexts, RecordOrder records,
                          TileOrder tiles) {
    RenderJob job = make_render_job(options, frames.at(0)->tile_size, contexts, records, tiles);
    for (const FrameWorkload* frame : frames) {
        job.add(borrowed(*frame));
    }
    return job;
}

} // namespace degs
