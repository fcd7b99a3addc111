// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/messages.hpp"

namespace degs {

/// Part of a row span inside one fixed-stride segment: the minimum scheduling unit (paper, Sec.
/// IV-B). Its tasks are put together when it is cut, as the Packing Unit wants them.
struct Segment {
    TaskRun run;
    std::uint64_t sequence = 0; ///< arrival order in the bank
    std::uint16_t feature = 0;  ///< Feature Buffer entry
};

/// Which ready conflict domain issues first. `RoundRobin`: the next one after the last that issued.
/// `Oldest`: the one whose head segment arrived first. `Deepest`: the one with most segments
/// waiting.
enum class DomainScan { RoundRobin, Oldest, Deepest };

/// The waiting segments of one bank: one first-in-first-out list per conflict domain (row x segment
/// of a tile in flight), all sharing one pool of entries. Keeps, per domain, the pixels that have
/// ended and the date from which the array may touch it again (the scoreboard).
class SegmentQueue {
public:
    SegmentQueue(int depth, int tiles_in_flight, int domains_per_tile, DomainScan scan);
    SegmentQueue(const SegmentQueue&) = delete; // slots point into bits_
    SegmentQueue& operator=(const SegmentQueue&) = delete;

    bool full() const { return free_ == kNone; }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }
    std::size_t waiting(int slot) const { return slots_[static_cast<std::size_t>(slot)].waiting; }

    /// Queues a segment that arrived as number `sequence`; the caller fills in its run and feature,
    /// in place: copying what was just written costs more than all else in here.
    Segment& push(int slot, int domain, std::uint64_t sequence);
    Segment& front(int slot, int domain) {
        return entries_[static_cast<std::size_t>(lists_[at(slot, domain)].head)].segment;
    }
    void pop(int slot, int domain);

    std::uint32_t ended(int slot, int domain) const { return lists_[at(slot, domain)].ended; }
    /// Marks pixels as ended; returns all that have.
    std::uint32_t end_pixels(int slot, int domain, std::uint32_t mask) {
        return lists_[at(slot, domain)].ended |= mask;
    }
    /// The array may touch the domain again from `date` on; at most kWheel - 1 cycles after the
    /// execution date of the next pick().
    void set_ready_at(int slot, int domain, Cycle date);
    bool has_waiting(int slot, int domain) const { return lists_[at(slot, domain)].head != kNone; }

    /// A domain of `slot` that has a segment and may execute at `date`, chosen by the scan rule; -1
    /// if none. Dates of successive calls do not fall.
    int pick(int slot, Cycle date);
    /// Earliest date at which a waiting domain of `slot` becomes ready; kNever if none is cooling.
    Cycle next_ready(int slot) const;
    static constexpr int kWheel = 128;

    /// Prepares `slot` for another tile; it must have no segments waiting.
    void clear(int slot);

private:
    static constexpr std::int32_t kNone = -1;
    struct Entry {
        Segment segment;
        std::int32_t next = kNone;
    };
    struct List {
        std::int32_t head = kNone, tail = kNone;
        std::uint32_t ended = 0;
        std::uint32_t length = 0;
    };
    /// What a tile in flight has in the queue. Bit sets run over domains, words_ words each.
    struct Slot {
        std::size_t waiting = 0;
        int cursor = 0;                    // domain after the last that was picked
        Cycle turned = 0;                  // the wheel has released everything up to this date
        std::uint64_t* occupied = nullptr; // has segments
        std::uint64_t* cooling = nullptr;  // within the reuse distance
        std::uint64_t* wheel = nullptr;    // kWheel sets: released at date mod kWheel
    };
    std::size_t at(int slot, int domain) const {
        return static_cast<std::size_t>(slot * domains_ + domain);
    }
    /// Arrival order of the head, below (inverse) length where that comes first: the smallest key
    /// of the ready domains is the one to pick. Kept by itself, so that a scan stays in one array.
    std::uint64_t key(std::uint64_t head_sequence, std::uint32_t length) const {
        return head_sequence | (std::uint64_t{~length & 0xFFFFU} << kSequenceBits & by_length_);
    }
    void release_all(Slot& slot) const;
    void turn_wheel(Slot& slot, Cycle date) const;
    int pick_next(Slot& slot) const;
    static std::uint64_t ready(const Slot& slot, std::size_t word) {
        return slot.occupied[word] & ~slot.cooling[word];
    }

    static constexpr int kSequenceBits = 48;
    static constexpr std::uint64_t kSequence = (std::uint64_t{1} << kSequenceBits) - 1;

    int domains_;
    std::size_t words_;
    DomainScan scan_;
    std::uint64_t by_length_; // all ones if the length counts
    std::vector<std::uint64_t> bits_, keys_;
    std::vector<Entry> entries_;
    std::int32_t free_ = kNone; // first of the list of free entries
    std::size_t size_ = 0;
    std::vector<List> lists_;
    std::vector<Slot> slots_;
};

} // namespace degs
