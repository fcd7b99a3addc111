// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/reuse_cache.hpp"

#include <algorithm>
#include <stdexcept>

namespace degs {

NextUse::NextUse(const RenderJob& job, std::uint32_t frame)
    : next_(job.frames[frame]->tile_splats.size(), kNone) {
    const FrameWorkload& work = *job.frames[frame];
    if (work.tile_splats.size() >= kNone) {
        throw std::length_error("reuse distances of a frame with 2^32 - 1 or more list entries");
    }
    std::vector<std::uint32_t> seen(work.splats.size(), kNone); // first use behind the entry
    for (std::size_t number = job.tiles.size(); number-- > job.tiles.first();) {
        const JobTile& tile = job.tiles[number];
        for (std::uint64_t i = tile.frame == frame ? tile.count : 0; i-- > 0;) {
            std::uint32_t& use = seen[work.tile_splats[tile.first + i]];
            next_[tile.before + i] = use;
            use = static_cast<std::uint32_t>(tile.before + i);
        }
    }
}

void NextUses::include(std::uint32_t frame) {
    frames_.drop_before(std::min(job_.frames.first(), frames_.size()));
    while (frames_.size() <= frame) {
        const std::size_t next = frames_.size();
        if (next < job_.frames.first()) {
            frames_.emplace_back();
        } else {
            frames_.emplace_back(NextUse(job_, static_cast<std::uint32_t>(next)));
        }
    }
}

ReuseCache::ReuseCache(const RenderJob& job, NextUses& next_uses, std::size_t records)
    : job_(job), next_uses_(next_uses), capacity_(records) {}

const std::vector<std::uint32_t>& ReuseCache::request(TileNumber tile, std::uint64_t first,
                                                      std::uint32_t count) {
    if (tile != tile_) {
        start_tile(tile);
    }
    missed_.clear();
    const JobTile& list = job_.tiles[tile];
    for (std::uint64_t place = first; place < first + count; ++place) {
        const std::uint32_t splat = job_.frames[frame_]->tile_splats[place];
        if (!look_up(splat, list.before + (place - list.first))) {
            missed_.push_back(splat);
        }
    }
    stats_.misses += missed_.size();
    stats_.hits += count - missed_.size();
    return missed_;
}

// Records that other engines' tiles would have used next wait for the use after that.
void ReuseCache::start_tile(TileNumber number) {
    const JobTile& tile = job_.tiles[number];
    if (tile_ == kNoTile || tile.frame != frame_) {
        frame_ = tile.frame;
        use_of_.assign(job_.frames[frame_]->splats.size(), kNowhere);
        by_use_.clear();
        resident_ = 0;
    }
    tile_ = number;
    std::size_t kept = 0;
    for (Rank rank : by_use_) {
        std::uint32_t& use = use_of_[rank.second];
        if (use != rank.first) {
            continue;
        }
        while (use < tile.before) {
            use = next_uses_.of(frame_).after(use);
        }
        if (use == NextUse::kNone) {
            --resident_;
        } else {
            by_use_[kept++] = {use, rank.second};
        }
    }
    by_use_.resize(kept);
    std::make_heap(by_use_.begin(), by_use_.end());
}

bool ReuseCache::look_up(std::uint32_t splat, std::uint64_t entry) {
    const std::uint32_t use = next_uses_.of(frame_).after(entry);
    const bool hit = use_of_[splat] != kNowhere;
    if (hit) {
        use_of_[splat] = kNowhere;
        --resident_;
    }
    if (use != NextUse::kNone) {
        keep(splat, use);
    }
    return hit;
}

void ReuseCache::keep(std::uint32_t splat, std::uint32_t use) {
    if (resident_ == capacity_) {
        if (farthest().first < use) {
            return;
        }
        evict_farthest();
    }
    use_of_[splat] = use;
    ++resident_;
    by_use_.emplace_back(use, splat);
    std::push_heap(by_use_.begin(), by_use_.end());
}

// Only if something is resident. Next uses are unique: an entry names one splat.
const ReuseCache::Rank& ReuseCache::farthest() {
    while (use_of_[by_use_.front().second] != by_use_.front().first) {
        std::pop_heap(by_use_.begin(), by_use_.end());
        by_use_.pop_back();
    }
    return by_use_.front();
}

void ReuseCache::evict_farthest() {
    use_of_[farthest().second] = kNowhere;
    --resident_;
    std::pop_heap(by_use_.begin(), by_use_.end());
    by_use_.pop_back();
}

} // namespace degs
