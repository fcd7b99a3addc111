// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/kit/job/messages.hpp"

namespace degs {

/// Part of a row span inside one fixed-stride segment: the minimum scheduling unit (paper, Sec.
/// IV-B). Its tasks are put together when it is cut, as the Packing Unit wants them.
struct Segment {
    TaskRun run;
    std::uint64_t sequence = 0; ///< arrival order in the bank
    std::uint16_t feature = 0;  ///< Feature Buffer entry
};

/// Which ready conflict domain issues first. `RoundRobin`: the next one after the last
/// that issued. `Oldest`: the one whose head segment arrived first. `Deepest`: the one
/// with most segments waiting.
enum class DomainScan { RoundRobin, Oldest, Deepest };

/// The waiting segments of one bank: one first-in-first-out list per conflict domain (row x segment
/// of a tile in flight), all sharing one pool of entries. Keeps, per domain, the pixels that have
/// ended and the date from which the array may touch it again (the scoreboard). Tiles in flight
/// belong to tile streams, in each of which they are numbered by their turn.
class SegmentQueue {
    struct Entry {
        Segment segment;
        Entry* next = nullptr;
    };
    struct List {
        Entry* head = nullptr;
        Entry** end = nullptr; // where the next segment is linked; &head if there is none
        std::uint32_t ended = 0;
        std::uint32_t live = ~0U;
        std::uint32_t length = 0;
    };

public:
    /// The part of a tile in flight. Bit sets run over domains, words_ words each.
    class Tile {
    public:
        void name(TileNumber number, std::int16_t context) {
            number_ = number;
            context_ = context;
        }
        TileNumber number() const { return number_; }     ///< kNoTile: none
        std::int16_t context() const { return context_; } ///< of the Pixel Buffer
        /// Segments that wait, in all domains.
        std::size_t waiting() const { return waiting_; }
        bool has_waiting(int domain) const { return lists_[domain].head != nullptr; }
        /// The oldest segment of the domain, which must have one.
        Segment& front(int domain) { return lists_[domain].head->segment; }

        /// Marks pixels as ended; returns all that have.
        std::uint32_t end_pixels(int domain, std::uint32_t mask) {
            return lists_[domain].ended |= mask;
        }
        /// Pixels of the domain that take tasks. Set by the bank; initially all pixels.
        std::uint32_t live(int domain) const { return lists_[domain].live; }
        void set_live(int domain, std::uint32_t mask) { lists_[domain].live = mask; }

    private:
        friend class SegmentQueue;
        std::uint64_t ready(std::size_t word) const {
            return occupied_[word] & ~cooling_[word] & ~held_back_[word];
        }

        TileNumber number_ = kNoTile;
        std::int16_t context_ = 0;
        std::size_t waiting_ = 0;
        int cursor_ = 0;        // domain after the last that was picked
        Cycle turned_ = 0;      // the wheel has released everything up to this date
        List* lists_ = nullptr; // by domain
        // By domain: what pick() goes by, see key(); not for RoundRobin.
        std::uint64_t* keys_ = nullptr;
        std::uint64_t* occupied_ = nullptr; // has segments
        std::uint64_t* cooling_ = nullptr;  // within the reuse distance
        // Chosen by a pipelined bank, and not packed yet.
        std::uint64_t* held_back_ = nullptr;
        std::uint64_t* wheel_ = nullptr; // kWheel sets: released at date mod kWheel
    };

    /// `tiles_in_flight`: of each stream, a power of two; see hold().
    SegmentQueue(int depth, int tiles_in_flight, int domains_per_tile, DomainScan scan,
                 int streams = 1);
    SegmentQueue(const SegmentQueue&) = delete; // tiles and entries point at each other
    SegmentQueue& operator=(const SegmentQueue&) = delete;

    /// Makes room for the turns `oldest` .. `latest` of a stream together; all others of the stream
    /// have been cleared. Invalidates references to its tiles.
    void hold(std::size_t oldest, std::size_t latest, std::size_t stream = 0) {
        while (latest - oldest >= rings_[stream].tiles.size()) {
            double_tiles(rings_[stream], oldest);
        }
    }
    /// The part of a stream's tile; turns a multiple of tiles_in_flight apart share one.
    Tile& tile(std::size_t turn, std::size_t stream = 0) { return rings_[stream].at(turn); }
    const Tile& tile(std::size_t turn, std::size_t stream = 0) const {
        return rings_[stream].at(turn);
    }

    bool full() const { return free_ == nullptr; }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }

    /// Queues a segment that arrived as number `sequence`. The caller fills in its run and feature
    /// in place, because copying data that was just written costs more than all else in this class.
    Segment& push(Tile& tile, int domain, std::uint64_t sequence);
    inline void pop(Tile& tile, int domain);

    /// The array may touch the domain again from `date` on; at most kWheel - 1 cycles after the
    /// execution date of the next pick().
    void set_ready_at(Tile& tile, int domain, Cycle date) const;
    /// The domain is not found until let_go().
    void hold_back(Tile& tile, int domain) const {
        tile.held_back_[word_of(domain)] |= bit_of(domain);
    }
    void let_go(Tile& tile, int domain) const {
        tile.held_back_[word_of(domain)] &= ~bit_of(domain);
    }
    /// A segment of the tile is packed at `date` without a find() at this date.
    void turn_to(Tile& tile, Cycle date) const {
        if (date > tile.turned_) {
            turn_wheel(tile, date);
        }
    }

    /// A domain of `tile` that has a segment and may execute at `date`, chosen by the scan rule; -1
    /// if none. Dates of successive calls do not fall.
    int pick(Tile& tile, Cycle date) const {
        const int domain = search(tile, date);
        took(tile, domain);
        return domain;
    }
    /// Finds what pick() takes, for a caller that chooses among tiles and calls took() for the one
    /// that it takes.
    int find(Tile& tile, Cycle date) const;
    /// RoundRobin goes on behind the domain; -1: none was found.
    void took(Tile& tile, int domain) const {
        if (scan_ == DomainScan::RoundRobin && domain >= 0) {
            tile.cursor_ = domain + 1 < domains_ ? domain + 1 : 0;
        }
    }
    /// The key of a domain that find() returned: among those of several tiles the smallest key goes
    /// first; not for RoundRobin.
    static std::uint64_t key_of(const Tile& tile, int domain) { return tile.keys_[domain]; }
    /// Earliest date at which a waiting domain of `tile` becomes ready; kNever if none is cooling.
    Cycle next_ready(const Tile& tile) const;
    static constexpr int kWheel = 128;

    /// Prepares `tile` for another one; it must have no segments waiting.
    void clear(Tile& tile) const;

private:
    /// Arrival order of the head, below (inverse) length where that comes first: the smallest key
    /// of the ready domains is the one to pick. Kept by itself, so that a scan stays in one array.
    std::uint64_t key(std::uint64_t head_sequence, std::uint32_t length) const {
        return scan_ == DomainScan::Deepest
                   ? head_sequence | std::uint64_t{~length & 0xFFFFU} << kSequenceBits
                   : head_sequence;
    }
    /// The tiles of a stream.
    struct Ring {
        std::vector<Tile> tiles; // as many as a power of two
        std::size_t mask = 0;
        Tile& at(std::size_t turn) { return tiles[turn & mask]; }
        const Tile& at(std::size_t turn) const { return tiles[turn & mask]; }
    };
    void add_tiles(Ring& ring, std::size_t count);
    void double_tiles(Ring& ring, std::size_t oldest);
    void clear_lists(Tile& tile) const;
    void release_all(Tile& tile) const;
    inline void turn_wheel(Tile& tile, Cycle date) const;
    inline int search(Tile& tile, Cycle date) const;
    inline int find_next(const Tile& tile) const;
    int find_least(const Tile& tile) const;
    static std::uint64_t bit_of(int domain) { return std::uint64_t{1} << (domain % 64U); }
    static std::size_t word_of(std::size_t domain) { return domain / 64; }
    /// The first domain that is set in word `word` of a set, which is `bits`.
    static int first_of(std::size_t word, std::uint64_t bits) {
        return static_cast<int>(word) * 64 + __builtin_ctzll(bits);
    }

    static constexpr int kSequenceBits = 48;

    /// The storage of some tiles. Entries point at lists, so the lists stay where they are.
    struct Block {
        std::vector<std::uint64_t> bits, keys;
        std::vector<List> lists;
    };

    int domains_;
    std::size_t words_;
    DomainScan scan_;
    std::vector<Block> blocks_;
    std::vector<Entry> entries_;
    Entry* free_ = nullptr; // first of the list of free entries
    std::size_t size_ = 0;
    std::vector<Ring> rings_; // by stream
};

// To a later date than before.
inline __attribute__((always_inline)) void SegmentQueue::turn_wheel(Tile& tile, Cycle date) const {
    if (date >= tile.turned_ + kWheel) {
        release_all(tile);
        tile.turned_ = date;
        return;
    }
    Cycle turned = tile.turned_;
    tile.turned_ = date;
    if (words_ == 1) {
        std::uint64_t cooling = *tile.cooling_;
        do {
            std::uint64_t& released = tile.wheel_[++turned % kWheel];
            cooling &= ~released;
            released = 0;
        } while (turned < date);
        *tile.cooling_ = cooling;
        return;
    }
    do {
        std::uint64_t* const released = tile.wheel_ + ++turned % kWheel * words_;
        for (std::size_t w = 0; w < words_; ++w) {
            tile.cooling_[w] &= ~released[w];
            released[w] = 0;
        }
    } while (turned < date);
}

// The first ready domain from the cursor on, round the end if need be.
inline __attribute__((always_inline)) int SegmentQueue::find_next(const Tile& tile) const {
    if (words_ == 1) { // as a rule: then without a branch that depends on the data
        const unsigned cursor = tile.cursor_;
        const std::uint64_t bits = tile.ready(0);
        if (bits == 0) {
            return -1;
        }
        const std::uint64_t rotated = bits >> cursor | bits << ((64 - cursor) % 64);
        return static_cast<int>((__builtin_ctzll(rotated) + cursor) % 64);
    }
    std::size_t w = word_of(tile.cursor_);
    std::uint64_t bits = tile.ready(w) & ~(bit_of(tile.cursor_) - 1);
    for (std::size_t step = 0; bits == 0 && step < words_; ++step) {
        w = w + 1 < words_ ? w + 1 : 0;
        bits = tile.ready(w); // last the cursor's word, where nothing is left above the cursor
    }
    return bits == 0 ? -1 : first_of(w, bits);
}

inline __attribute__((always_inline)) int SegmentQueue::search(Tile& tile, Cycle date) const {
    if (date > tile.turned_) {
        turn_wheel(tile, date);
    }
    return scan_ == DomainScan::RoundRobin ? find_next(tile) : find_least(tile);
}

// Inlined in the hot loop, because a call costs as much as the work.
inline __attribute__((always_inline)) void SegmentQueue::pop(Tile& tile, int domain) {
    List& list = tile.lists_[domain];
    Entry& entry = *list.head;
    Entry* const second = entry.next;
    entry.next = free_;
    free_ = &entry;
    size_--;
    tile.waiting_--;
    list.head = second;
    list.length--;
    // There is no branch, because both outcomes are equally likely. The key of an empty list is
    // never read.
    const bool last = second == nullptr;
    const Entry& head = last ? entry : *second;
    list.end = last ? &list.head : list.end;
    if (scan_ != DomainScan::RoundRobin) {
        tile.keys_[domain] = key(head.segment.sequence, list.length);
    }
    tile.occupied_[word_of(domain)] ^= std::uint64_t{last} << (domain % 64U);
    __builtin_prefetch(head.next);
}

} // namespace degs
