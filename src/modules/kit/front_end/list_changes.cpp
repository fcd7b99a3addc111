// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/list_changes.hpp"

#include <algorithm>

namespace degs {

bool ListChanges::keeps(std::uint32_t frame) const {
    const std::optional<std::uint32_t> earlier = job_.view_before(frame);
    if (!lists_are_kept_ || !earlier) {
        return false;
    }
    const FrameWorkload& before = *job_.frames[*earlier];
    const FrameWorkload& now = *job_.frames[frame];
    return before.gaussians == now.gaussians && before.tiles_x == now.tiles_x &&
           before.tiles_y == now.tiles_y &&
           job_.bases[*earlier].workspace == job_.bases[frame].workspace;
}

std::size_t ListChanges::grid_index(const JobTile& tile) const {
    return job_.frame_of(tile).grid().tile_of_pixel(tile.x, tile.y);
}

void ListChanges::mark(std::uint32_t frame, std::vector<bool>& written) {
    const FrameWorkload& now = *job_.frames[frame];
    written.assign(now.tile_pairs(), true);
    if (!keeps(frame)) {
        return;
    }
    const FrameWorkload& before = *job_.frames[*job_.view_before(frame)];
    std::vector<std::uint32_t> listed_in(now.gaussians, 0); // the last tile, counted from 1
    for (int tile = 0; tile < now.tiles(); ++tile) {
        const std::uint32_t mark = tile + 1;
        for (std::uint64_t i = before.tile_begin[tile]; i < before.tile_begin[tile + 1]; ++i) {
            listed_in[before.splats[before.tile_splats[i]].id] = mark;
        }
        for (std::uint64_t i = now.tile_begin[tile]; i < now.tile_begin[tile + 1]; ++i) {
            written[i] = listed_in[now.splats[now.tile_splats[i]].id] != mark;
        }
    }
}

ListChanges::Frame ListChanges::count(std::uint32_t frame) {
    const FrameWorkload& work = *job_.frames[frame];
    std::vector<bool> written;
    mark(frame, written);
    Frame counts;
    for (int tile = 0; tile < work.tiles(); ++tile) {
        std::uint32_t count = 0;
        for (std::uint64_t i = work.tile_begin[tile]; i < work.tile_begin[tile + 1]; ++i) {
            count += written[i] ? 1 : 0;
        }
        counts.per_tile.push_back(count);
    }
    return counts;
}

// A frame is asked about while the one before it, from which lists are kept, has not retired.
const ListChanges::Frame& ListChanges::of_frame(std::uint32_t frame) {
    while (frames_.size() <= frame) {
        frames_.emplace_back();
        frames_.drop_before(std::min(job_.frames.first(), frames_.size()));
    }
    Frame& counts = frames_[frame];
    if (counts.per_tile.empty()) {
        counts = count(frame);
    }
    return counts;
}

} // namespace degs
