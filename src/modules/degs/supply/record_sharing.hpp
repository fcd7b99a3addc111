// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <list>
#include <unordered_map>
#include <vector>

#include "modules/kit/job/render_job.hpp"
#include "stats/statistics.hpp"
#include "tlm/completion.hpp"

namespace degs {

/// Which splat records have to be read when several tiles are in work: neither those that another
/// tile's read has brought, nor those that a cache holds.
///
/// Multicast: a record that is read for one fetcher is captured by every other fetcher that has the
/// splat among the next `window` entries of its tile's list, counted from the first one that has
/// not been requested. A fetcher's window opens with its first request of a tile.
///
/// Cache: of all fetchers together, least recently used record replaced, fully associative
/// [assumed]. It keeps what is read, also while it is on its way.
///
/// It has no time of its own: requests come in the order in which they count.
class RecordSharing {
public:
    struct Stats {
        std::uint64_t requested = 0, read = 0, captured = 0, hits = 0, unused = 0;
        std::uint64_t cached = 0; ///< written to the cache
    };

    /// `job` outlives it. `window`: list entries, 0: no multicast; `cache`: records, 0: none.
    RecordSharing(const RenderJob& job, std::size_t fetchers, std::size_t window,
                  std::size_t cache);

    /// The next chunk of a fetcher: chunks of a tile come in order, one with `last` ends it.
    /// Returns the splats whose records have to be read, valid until the next call.
    const std::vector<std::uint32_t>& request(std::size_t fetcher, const SplatChunk& chunk);
    /// When all records of the chunk of the last request are there, if those that had to be read
    /// are there at `read`. Must follow each request of which any had.
    Completion complete(const Completion& read);
    /// When those are there that did not have to be read.
    const Completion& known() const { return known_; }

    const Stats& stats() const { return stats_; }

private:
    using Key = std::uint64_t; // frame and splat
    struct Window {
        TileNumber tile = kNoTile;
        std::uint64_t next = 0, end = 0; // entries [next, end) of the frame's lists are inside
        std::unordered_map<std::uint32_t, Completion> captured; // by splat, of these entries
    };
    struct Record {
        Key key;
        Completion there;
    };

    Key key_of(std::uint32_t splat) const { return Key{frame_} << 32U | splat; }
    const std::uint32_t* splats(const SplatChunk& chunk) const;
    bool capture_used(Window& window, std::uint32_t splat);
    bool hit(std::uint32_t splat);
    void look_up(Window& window, std::uint32_t splat);
    void leave(std::size_t fetcher, std::uint32_t splat);
    void move_window(std::size_t fetcher, const SplatChunk& chunk);
    void close_window(std::size_t fetcher);
    void keep(std::uint32_t splat, const Completion& there);

    const RenderJob& job_;
    std::size_t window_entries_, cache_records_;
    std::vector<Window> windows_;                         // by fetcher
    std::unordered_multimap<Key, std::size_t> listeners_; // fetchers that would capture a record
    std::list<Record> recent_;                            // of the cache, latest use first
    std::unordered_map<Key, std::list<Record>::iterator> places_;
    std::uint32_t frame_ = 0; // of the last request
    Completion known_;
    std::vector<std::uint32_t> missed_; // splats of the last request
    Stats stats_;
};

} // namespace degs
