// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "config/config.hpp"
#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/sram_ports.hpp"
#include "stats/statistics.hpp"
#include "tlm/clock_domain.hpp"

namespace degs {

/// One bank's part of the Feature Buffer (paper Table I; Global Gaussian Parameters by G_ID). An
/// entry is taken when the first row of a splat enters the bank and given back when the last task
/// of its last row has been written back. A splat is open while more of its rows may come: until
/// `open_splats` others of its tile stream have entered after it, as many as can send rows in turn.
/// Open splats of a stream never take the share of another, so that no stream can lock another one
/// out. Entries are taken in the order in which they became free, and from the first on when all
/// are free [assumed], so that a frame does not depend on those before it. Partitioned per bank, so
/// that every array slice has its own read port [assumed].
class FeatureBuffer {
public:
    /// How the parameters of a splat come from the Gaussian Buffer. They are sent along with the
    /// splat's rows and written when the first row enters the bank [assumed].
    struct Fill {
        int cycles = 0;        ///< that writing an entry takes; 0: it is there at once
        BankedSramPorts ports; ///< an entry takes a write port of its SRAM bank for that time
    };
    struct Config {
        int bytes = 8 * 1024; ///< of all banks
        int entry_bytes = 16;
        Fill fill{0, {{0}, 8}};
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        std::uint64_t entries = 0;
        std::uint64_t waits = 0;
        std::uint64_t fill_waits = 0;
        void describe(StatsVisitor& v) const {
            v.count("entries", entries, "splats",
                    "Entries written, one for each splat and bank that it reaches.");
            v.count("waits", waits, "splats", "Splats that found no free entry and waited.");
            v.count("fill_waits", fill_waits, "cycles",
                    "Spans that waited until the parameters of their splat had been written.");
        }
    };

    /// There must be at least one entry per stream.
    FeatureBuffer(int entries, int open_splats, int streams, const Fill& fill);
    explicit FeatureBuffer(int entries, int open_splats = 1, int streams = 1)
        : FeatureBuffer(entries, open_splats, streams, Fill()) {}

    /// Makes (tile, splat) the splat that enters; `stream` works on the tile. False if no entry is
    /// free at `now`.
    __attribute__((always_inline)) bool admit(TileNumber tile, std::uint32_t splat, Cycle now,
                                              std::size_t stream = 0) {
        const std::uint64_t wanted = key(tile, splat);
        return wanted == current_key_ || (several_open_ && find(wanted, stream)) ||
               enter(wanted, now, streams_.data()[stream]);
    }
    /// The entry of the splat that admit() has let in last.
    std::uint16_t current() const { return current_; }
    /// True if the parameters of the splat that enters can be read at `date`.
    bool filled_by(Cycle date) {
        const bool filled = entries_[current_].filled <= date;
        stats_.fill_waits += filled ? 0 : 1;
        return filled;
    }
    void hold(std::uint16_t entry) { entries_.data()[entry].held++; }
    /// Gives up one hold on an entry, whose parameters are needed until `date`.
    __attribute__((always_inline)) void release(std::uint16_t entry, Cycle date) {
        Entry& e = entries_.data()[entry];
        e.needed_until = std::max(e.needed_until, date);
        if (--e.held == 0) {
            retire(entry, e.needed_until);
        }
    }
    /// Closes the open splats of a stream, because no more of their rows will come.
    void close(Cycle now, std::size_t stream = 0);
    /// Date at which the next entry becomes free; kNever if none is on its way.
    Cycle next_free() const { return free_count_ == 0 ? kNever : first_free_->date; }
    const Stats& stats() const { return stats_; }

private:
    struct Entry {
        Cycle needed_until = 0;
        std::uint32_t held = 0; ///< task groups, and one while more rows may come
        Cycle filled = 0;       ///< date from which it can be read
    };
    struct Free {
        Cycle date; // from which it may be taken
        std::uint16_t entry;
    };
    static constexpr std::uint64_t kNobody = ~std::uint64_t{0}; // no tile has the number kNoTile
    static std::uint64_t key(TileNumber tile, std::uint32_t splat) {
        return std::uint64_t{tile} << 32U | splat;
    }
    struct Open {
        std::uint64_t key = kNobody;
        std::uint16_t entry = 0;
    };
    struct Stream {
        std::vector<Open> splats; // ring in the order of their first rows
        Open *first = nullptr, *end = nullptr;
        Open* oldest = nullptr;
        Open* next = nullptr; // place of the next one, which is the oldest if all are taken
        std::size_t count = 0;
        bool waiting = false; // a splat has found no entry
        Open* after(Open* place) const { return place + 1 == end ? first : place + 1; }
    };
    inline bool find(std::uint64_t splat, std::size_t stream);
    bool enter(std::uint64_t splat, Cycle now, Stream& own);
    void close_oldest(Stream& own, Cycle now);
    void retire(std::uint16_t entry, Cycle date);
    void take_in_order();
    Cycle fill(std::uint16_t entry, Cycle now);
    Free* next(Free* place) const { return place == last_ ? first_ : place + 1; }

    std::vector<Entry> entries_;
    std::vector<Free> free_; // ring in order of dates, which do not fall
    Free *first_, *last_;    // of the ring
    Free* first_free_;
    Free* end_free_;
    std::size_t free_count_, size_; // free entries, and all
    bool several_open_;             // splats at a time
    Cycle last_retired_ = 0;
    Fill fill_;
    std::vector<Cycle> write_ports_; // dates at which they are free, SRAM bank by bank
    std::vector<Stream> streams_;
    std::uint64_t current_key_ = kNobody; // key() of the current splat
    std::uint16_t current_ = 0;
    Stats stats_;
};

// One of the stream's open splats beside the current one.
inline __attribute__((always_inline)) bool FeatureBuffer::find(std::uint64_t splat,
                                                               std::size_t stream) {
    const Stream& own = streams_.data()[stream];
    for (const Open* open = own.first; open != own.end; ++open) {
        if (open->key == splat) {
            current_key_ = splat;
            current_ = open->entry;
            return true;
        }
    }
    return false;
}

// What follows is inlined in the hot loops of banks: most splats that enter close another one.
inline __attribute__((always_inline)) void FeatureBuffer::close_oldest(Stream& own, Cycle now) {
    Open& oldest = *own.oldest;
    own.oldest = own.after(own.oldest);
    own.count--;
    if (oldest.key == current_key_) {
        current_key_ = kNobody;
    }
    oldest.key = kNobody;
    Entry& e = entries_.data()[oldest.entry];
    if (--e.held == 0) {
        retire(oldest.entry, std::max(now, e.needed_until));
    }
}

inline __attribute__((always_inline)) void FeatureBuffer::retire(std::uint16_t entry, Cycle date) {
    last_retired_ = std::max(last_retired_, date);
    *end_free_ = {last_retired_, entry};
    end_free_ = next(end_free_);
    free_count_++;
}

inline __attribute__((always_inline)) bool FeatureBuffer::enter(std::uint64_t splat, Cycle now,
                                                                Stream& own) {
    if (own.next == own.oldest && own.count != 0) {
        close_oldest(own, now);
    }
    if (free_count_ == size_ && last_retired_ <= now) {
        take_in_order();
    }
    if (next_free() > now) {
        stats_.waits += own.waiting ? 0 : 1;
        own.waiting = true;
        return false;
    }
    own.waiting = false;
    stats_.entries++;
    current_ = first_free_->entry;
    first_free_ = next(first_free_);
    free_count_--;
    entries_.data()[current_] = {now, 1, fill_.cycles == 0 ? now : fill(current_, now)};
    current_key_ = splat;
    *own.next = {splat, current_};
    own.next = own.after(own.next);
    own.count++;
    return true;
}

} // namespace degs
