// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "base/ratio.hpp"
#include "dram/timing.hpp"

namespace degs::dram {

/// One entry of a controller queue: up to 64 bytes of one row, read or written.
struct Access {
    Ck date = 0;          ///< first CK in which it may send a command
    std::uint32_t id = 0; ///< of the requester
    std::uint32_t row = 0;
    std::uint32_t writes = 0; ///< to the channel before it, a write itself included; may wrap
    std::uint8_t bank = 0;
    std::uint8_t block = 0;  ///< of 64 bytes in the row
    std::uint8_t bursts = 1; ///< mask: which bursts of the block
    std::uint8_t qos = 0;    ///< a read: level, 0 to 15; the higher ones wait for room first
    bool write = false;
    bool urgent = false;      ///< a read: of its level, waits for room before those that are not
    bool after_write = false; ///< a read: an older write to the block may be waiting
};

/// Bursts that a mask names.
constexpr unsigned bursts_of(unsigned mask) {
    return __builtin_popcount(mask);
}

/// State of the row buffer when an access was first served.
enum class RowState : std::uint8_t { Hit, Closed, Conflict };
using ByRowState = std::array<std::uint64_t, 3>;

/// Share of accesses that found their row open, 0 to 1; 0 if there are none.
inline double hit_rate(const ByRowState& counts) {
    const auto [hits, closed, conflicts] = counts;
    return ratio_of(hits, hits + closed + conflicts);
}

/// A controller queue of one direction: fixed slots, and a list per bank in the order of arrival. A
/// level more counts as having arrived `step` accesses earlier.
class Queue {
public:
    static constexpr int kSlots = 64;
    static constexpr std::uint8_t kNone = 0xFF;
    struct Entry {
        Access access;
        std::uint64_t age = 0; ///< counts arrivals; less for a higher level
        std::uint8_t left = 0; ///< mask of bursts that have not been issued
        RowState outcome = RowState::Hit;
        std::uint8_t next = kNone, previous = kNone; ///< of the same bank
    };

    static constexpr int kMostStep = 512;

    /// `depth`: 1 to kSlots; `step`: 0 to kMostStep.
    explicit Queue(int depth, int step = 0)
        : step_(static_cast<unsigned>(step)),
          free_(depth >= kSlots ? ~std::uint64_t{0} : (std::uint64_t{1} << depth) - 1) {
        head_.fill(kNone);
        tail_.fill(kNone);
    }
    unsigned size() const { return size_; }
    std::uint64_t arrivals() const { return arrivals_; } ///< so far; the next one's age
    bool full() const { return free_ == 0; }
    /// Banks for which something waits, as a mask.
    std::uint32_t banks() const { return banks_; }
    Entry& operator[](unsigned slot) { return entries_[slot]; }
    const Entry& operator[](unsigned slot) const { return entries_[slot]; }

    /// The queue must not be full. Returns the slot.
    std::uint8_t push(const Access& access) {
        const auto slot = static_cast<std::uint8_t>(__builtin_ctzll(free_));
        free_ &= free_ - 1;
        const unsigned bank = access.bank;
        Entry& entry = entries_[slot]; // in place, which is faster than to copy an entry
        entry.access = access;
        entry.age = arrivals_++ - std::uint64_t{step_} * access.qos;
        entry.left = access.bursts;
        entry.outcome = RowState::Hit;
        std::uint8_t previous = tail_[bank];
        while (previous != kNone && entries_[previous].age > entry.age) {
            previous = entries_[previous].previous;
        }
        entry.previous = previous;
        entry.next = previous == kNone ? head_[bank] : entries_[previous].next;
        (previous == kNone ? head_[bank] : entries_[previous].next) = slot;
        (entry.next == kNone ? tail_[bank] : entries_[entry.next].previous) = slot;
        banks_ |= 1U << bank;
        ++size_;
        return slot;
    }
    void remove(unsigned slot) {
        const Entry& entry = entries_[slot];
        const unsigned bank = entry.access.bank;
        (entry.previous == kNone ? head_[bank] : entries_[entry.previous].next) = entry.next;
        (entry.next == kNone ? tail_[bank] : entries_[entry.next].previous) = entry.previous;
        if (head_[bank] == kNone) {
            banks_ &= ~(1U << bank);
        }
        free_ |= std::uint64_t{1} << slot;
        --size_;
    }

    /// Slots; kNone if there is none.
    std::uint8_t oldest(unsigned bank) const { return head_[bank]; }
    std::uint8_t oldest_of_row(unsigned bank, std::uint32_t row) const {
        std::uint8_t slot = head_[bank];
        while (slot != kNone && entries_[slot].access.row != row) {
            slot = entries_[slot].next;
        }
        return slot;
    }
    /// The oldest access of the bank if it wants the row, else kNone; only if the bank has one.
    std::uint8_t oldest_if_hit(unsigned bank, std::uint32_t row) const {
        return entries_[head_[bank]].access.row == row ? head_[bank] : kNone;
    }
    std::uint8_t find(unsigned bank, std::uint32_t row, unsigned block) const {
        std::uint8_t slot = head_[bank];
        while (slot != kNone &&
               (entries_[slot].access.row != row || entries_[slot].access.block != block)) {
            slot = entries_[slot].next;
        }
        return slot;
    }
    /// Bursts that have not been issued, of all entries.
    std::uint64_t bursts_left() const {
        std::uint64_t bursts = 0;
        for (std::uint32_t rest = banks_; rest != 0; rest &= rest - 1) {
            for (std::uint8_t slot = head_[first_bank(rest)]; slot != kNone;
                 slot = entries_[slot].next) {
                bursts += bursts_of(entries_[slot].left);
            }
        }
        return bursts;
    }
    /// The bank that holds the oldest entry of all; only if not empty.
    unsigned oldest_bank() const {
        unsigned best = first_bank(banks_);
        for (std::uint32_t rest = banks_ & (banks_ - 1); rest != 0; rest &= rest - 1) {
            const unsigned bank = first_bank(rest);
            if (entries_[head_[bank]].age < entries_[head_[best]].age) {
                best = bank;
            }
        }
        return best;
    }

private:
    static constexpr std::uint64_t kFirstArrival = 1U << 16U; // no age is negative

    std::array<Entry, kSlots> entries_;
    std::array<std::uint8_t, kMostBanks> head_, tail_;
    unsigned step_;
    std::uint64_t free_;
    std::uint64_t arrivals_ = kFirstArrival;
    std::uint32_t banks_ = 0;
    unsigned size_ = 0;
};

} // namespace degs::dram
