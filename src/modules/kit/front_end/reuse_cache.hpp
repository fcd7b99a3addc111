// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "modules/kit/job/render_job.hpp"
#include "stats/statistics.hpp"

namespace degs {

/// For every entry of a frame's tile lists the next entry, in the order in which the job takes the
/// tiles, that names the same splat. Entries are counted in that order, too: entry i of a tile is
/// number JobTile::before + i.
class NextUse {
public:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    /// One backward pass over the lists; all tiles of the frame must be in the job. Throws
    /// std::length_error if there are 2^32 - 1 entries or more.
    NextUse(const RenderJob& job, std::uint32_t frame);

    /// The next use after `entry`, or kNone.
    std::uint32_t after(std::uint64_t entry) const { return next_[entry]; }

private:
    std::vector<std::uint32_t> next_;
};

/// Next uses of all frames of a job, made when a frame is first asked for. Shared by all caches.
class NextUses {
public:
    explicit NextUses(const RenderJob& job) : job_(job) {}
    /// The reference is valid until the next call with another new frame.
    const NextUse& of(std::uint32_t frame) {
        if (frame >= frames_.size()) {
            include(frame);
        }
        return *frames_[frame];
    }

private:
    void include(std::uint32_t frame);

    const RenderJob& job_;
    KeptList<std::optional<NextUse>> frames_; // nothing for frames that nobody had asked for
};

/// A cache that keeps splat records between the tiles of one engine (Ye et al., HPCA 2025). Reuse
/// distances that binning has computed in advance decide which record is replaced: the one whose
/// next use is farthest away, which may be the record that has just been read. Next uses are those
/// of all tiles in the order of the job, whichever engine works on them; once the engine has passed
/// a tile, its entries no longer count. Fully associative [assumed].
///
/// The cache has no time of its own: the Splat Fetcher asks which records it must read.
class ReuseCache {
public:
    struct Stats {
        std::uint64_t hits = 0, misses = 0;
        void describe(StatsVisitor& v) const {
            v.count("hits", hits, "records", "Splat records found in the caches.");
            v.count("misses", misses, "records", "Splat records read from memory.");
        }
    };

    /// Both outlive the cache. `records`: capacity, >= 1.
    ReuseCache(const RenderJob& job, NextUses& next_uses, std::size_t records);

    /// Looks up `count` list entries from `first` on; tiles never go back. Returns the splats whose
    /// records have to be read, valid until the next call.
    const std::vector<std::uint32_t>& request(TileNumber tile, std::uint64_t first,
                                              std::uint32_t count);

    const Stats& stats() const { return stats_; }

private:
    static constexpr std::uint32_t kNowhere = ~std::uint32_t{0};
    using Rank = std::pair<std::uint32_t, std::uint32_t>; // next use, splat

    void start_tile(TileNumber number);
    bool look_up(std::uint32_t splat, std::uint64_t entry);
    void keep(std::uint32_t splat, std::uint32_t use);
    void evict_farthest();
    const Rank& farthest();

    const RenderJob& job_;
    NextUses& next_uses_;
    std::size_t capacity_;
    TileNumber tile_ = kNoTile;
    std::uint32_t frame_ = 0;
    std::vector<std::uint32_t> use_of_; // per splat: its next use if resident, else kNowhere
    std::vector<Rank> by_use_; // max-heap; entries that use_of_ contradicts are out of date
    std::size_t resident_ = 0;
    std::vector<std::uint32_t> missed_; // splats of the last request
    Stats stats_;
};

} // namespace degs
