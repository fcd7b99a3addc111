// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/list_writes.hpp"

#include <algorithm>

namespace degs {
namespace {

/// Per splat in near-to-far order: its rank among visible Gaussians in the order of the scene.
std::vector<std::uint32_t> scene_ranks(const FrameWorkload& frame) {
    std::vector<std::uint32_t> ranks;
    ranks.reserve(frame.splats.size());
    for (const ProjectedSplat& splat : frame.splats) {
        ranks.push_back(frame.visible_among(splat.id));
    }
    return ranks;
}

} // namespace

void ListWrites::begin(const FrameWorkload& frame, const std::vector<bool>& written) {
    next_ = 0;
    const std::vector<std::uint32_t> ranks = scene_ranks(frame);
    const std::vector<std::uint32_t>& splats = frame.tile_splats;
    before_.assign(ranks.size() + 1, 0);
    for (std::size_t i = 0; i < splats.size(); ++i) {
        before_[ranks[splats[i]] + 1] += written[i] ? 1 : 0;
    }
    for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
        before_[rank + 1] += before_[rank];
    }
    std::vector<std::uint64_t> at(before_.begin(), before_.end() - 1);
    tile_of_.resize(before_.back());
    end_.assign(frame.tile_begin.begin(), frame.tile_begin.end() - 1);
    for (int tile = 0; tile < frame.tiles(); ++tile) {
        for (std::uint64_t i = frame.tile_begin[tile]; i < frame.tile_begin[tile + 1]; ++i) {
            if (written[i]) {
                tile_of_[at[ranks[splats[i]]]++] = static_cast<std::uint32_t>(tile);
            } else {
                ++end_[tile]; // entries that are there come first
            }
        }
    }
    grouped_.assign(frame.tiles(), 0);
}

const ListWrites::Batch& ListWrites::next(std::uint64_t count) {
    batch_.entries = count;
    batch_.bursts.clear();
    batch_.tiles.clear();
    const std::uint64_t end = next_ + count;
    if (writing_ == ListWriting::Entries) {
        for (; next_ < end; ++next_) {
            write(tile_of_[next_], 1);
        }
        return batch_;
    }
    std::vector<std::uint32_t> tiles;
    for (; next_ < end; ++next_) {
        const std::uint32_t tile = tile_of_[next_];
        if (grouped_[tile]++ == 0) {
            tiles.push_back(tile);
        }
    }
    for (const std::uint32_t tile : tiles) {
        write(tile, grouped_[tile]);
        grouped_[tile] = 0;
    }
    return batch_;
}

void ListWrites::write(std::uint32_t tile, std::uint64_t count) {
    const std::uint64_t entry = traffic_.list_entry_bytes;
    const std::uint64_t burst = traffic_.burst_bytes;
    const std::uint64_t first = end_[tile] * entry / burst;
    end_[tile] += count;
    const std::uint64_t last = (end_[tile] * entry - 1) / burst;
    for (std::uint64_t i = first; i <= last; ++i) {
        batch_.bursts.push_back(static_cast<std::uint32_t>(i));
    }
    batch_.tiles.push_back(tile);
}

} // namespace degs
