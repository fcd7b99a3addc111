// SPDX-License-Identifier: Apache-2.0
// What a bank of drawn tasks issues into packets. It is inlined in the loop over cycles, so that
// only drawn_bank.cpp includes it.
#pragma once

#include <algorithm>

#include "modules/degs/scheduler/drawn_bank.hpp"

namespace degs {

// Issue. Returns the number of segments issued.

template <DrawnBank::Intake intake, DrawnBank::Choice choice>
inline __attribute__((always_inline)) int DrawnBank::issue() {
    no_room_ = false;
    if (issuable_ == 0) {
        width_limited_ = false;
        return 0;
    }
    const bool in_order = intake == Intake::Single || (intake == Intake::Rings && single_stream_);
    const int issued = choice == Choice::Oldest ? issue_oldest()
                       : in_order               ? issue_in_order<choice>()
                                                : issue_from_all<choice>();
    width_limited_ = issued == issue_width_;
    return issued;
}

// A domain of the tile that may execute at `slot`, chosen by the scan rule: its number below what
// makes one of two domains go first; kNothing if there is none.
template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) std::uint64_t DrawnBank::find(const Tile& tile,
                                                                    Cycle slot) const {
    constexpr bool in_turn = choice == Choice::InTurn;
    if (!in_turn && scan_ == DomainScan::Deepest) {
        return tile.lanes.longest(slot);
    }
    const std::uint32_t found = in_turn ? tile.lanes.next_from(tile.cursor, slot)
                                : scan_ == DomainScan::RoundRobin
                                    ? tile.lanes.next_keyed_from(tile.cursor, slot)
                                    : tile.lanes.least(slot);
    return found >= DomainLanes::kTop ? kNothing : found;
}

// For a single stream; see IssueBank::issue_segments().
template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) int DrawnBank::issue_in_order() {
    Tile* const* const first = started_.data();
    Tile* const* const end = first + started_.size();
    Tile* const* place = first;
    Cycle slot = packet_.next_execution(now_);
    int issued = 0;
    while (place != end) {
        Tile& tile = **place;
        const std::uint64_t found = tile.waiting == 0 ? kNothing : find<choice>(tile, slot);
        if (found == kNothing) {
            ++place;
            continue;
        }
        const auto number = static_cast<int>(found & tile.lanes.mask());
        if (!issue_one<choice>(tile, number, slot)) {
            break;
        }
        tile.cursor = after(number);
        if (++issued == issue_width_) {
            break;
        }
        if (const Cycle date = packet_.next_execution(now_); date != slot) {
            slot = date;
            place = first; // the older tile may have a ready domain now
        }
    }
    return issued;
}

// Looks for a domain of the stream that may issue, in its oldest tile that has one. False if there
// is none.
template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) bool DrawnBank::find_ready(std::size_t number, Cycle slot) {
    Stream& ready = own_[number];
    if (ready.only != nullptr) {
        ready.tile = ready.only;
        ready.rank = ready.only->waiting == 0 ? kNothing : find<choice>(*ready.only, slot);
        return ready.rank != kNothing;
    }
    const BankStream& stream = streams_[number];
    Tile* const* const end = started_.data() + stream.end_started;
    for (Tile* const* place = started_.data() + stream.first_started; place != end; ++place) {
        Tile& tile = **place;
        ready.rank = tile.waiting == 0 ? kNothing : find<choice>(tile, slot);
        if (ready.rank != kNothing) {
            ready.tile = &tile;
            return true;
        }
    }
    return false;
}

// The next stream that has a ready domain, that which issued last at the end; if there is none,
// their number.
template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) std::size_t DrawnBank::first_ready(Cycle slot) {
    std::size_t stream = issued_stream_;
    do {
        stream = stream + 1 == own_.size() ? 0 : stream + 1;
        if (find_ready<choice>(stream, slot)) {
            return stream;
        }
    } while (stream != issued_stream_);
    return own_.size();
}

// The stream whose ready domain goes first; if there is none, their number. What was found for this
// slot holds until it is issued.
template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) std::size_t DrawnBank::least_ready(Cycle slot) {
    std::size_t chosen = own_.size();
    std::uint64_t least = kNothing;
    for (std::size_t i = 0; i < own_.size(); ++i) {
        if (own_[i].rank == kNothing) {
            find_ready<choice>(i, slot);
        }
        chosen = own_[i].rank < least ? i : chosen;
        least = std::min(own_[i].rank, least);
    }
    return chosen;
}

// For several streams; see IssueBank::issue_segments().
template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) int DrawnBank::issue_from_all() {
    const bool in_turn = choice == Choice::InTurn || scan_ == DomainScan::RoundRobin;
    int issued = 0;
    for (Cycle date = 0; issued < issue_width_; ++issued) {
        const Cycle slot = packet_.next_execution(now_);
        if (!in_turn && slot != date) { // another domain may be ready now
            date = slot;
            for (Stream& ready : own_) {
                ready.rank = kNothing;
            }
        }
        const std::size_t chosen = in_turn ? first_ready<choice>(slot) : least_ready<choice>(slot);
        if (chosen == own_.size()) {
            break;
        }
        Stream& ready = own_[chosen];
        const auto number = static_cast<int>(ready.rank & ready.tile->lanes.mask());
        if (!issue_one<choice>(*ready.tile, number, slot)) {
            break;
        }
        ready.tile->cursor = after(number);
        ready.rank = kNothing;
        issued_stream_ = chosen;
    }
    return issued;
}

/// Counts tasks. Which of them go into a packet matters only if a pixel ends with one: `ends`.
template <bool ends>
class DrawnBank::Sink {
public:
    Sink(DrawnBank& bank, const Tile& tile, int number, std::uint32_t ended)
        : bank_(bank), tile_(tile), number_(number), ended_(ended) {}
    void end_idle() {
        if (bank_.idle_pending_) {
            bank_.idle_pending_ = false;
            bank_.packing_.settle_idle();
        }
    }
    void begin() {}
    int take(std::uint32_t& left, int count, int room, Cycle slot) {
        if constexpr (ends) {
            const std::uint32_t ended = take_lowest(left, count, room) & ended_;
            if (ended != 0) {
                bank_.end_drawn(tile_, number_, ended, slot);
            }
        }
        return std::min(count, room);
    }
    __attribute__((always_inline)) void send(Slot /*none: the packet is full*/) { bank_.send(); }

private:
    DrawnBank& bank_;
    const Tile& tile_;
    int number_;
    std::uint32_t ended_;
};

// False if the Packing Buffer has no room.
template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) bool DrawnBank::issue_one(Tile& tile, int number,
                                                                Cycle slot) {
    Domain& domain = tile.domains[number];
    const Waiting& segment = *domain.head;
    std::uint32_t tasks = segment.mask;
    if ((tasks & ~domain.live) != 0) {
        tasks = tasks_of(segment, domain.live);
    }
    const int count = __builtin_popcount(tasks);
    if (count != 0 && !(packet_.fits(now_, slot, count) && packet_.can_write(now_, count))) {
        no_room_ = true;
        return false;
    }
    Cycle last = now_;
    if (count != 0) {
        if (const std::uint32_t ended = tasks & segment.ended; ended != 0) {
            last = pack_ends(tile, number, tasks, ended);
        } else {
            Sink<false> sink(*this, tile, number, 0);
            last = packet_.pack(now_, tasks, count, sink);
        }
        last += reuse_;
        tile.lanes.set_date(number, last);
    }
    if (trace_ != nullptr) {
        trace_->add({now_, slot, last, tile.context, number, tasks});
    }
    if (tasks != segment.mask) {
        drop(segment, segment.mask ^ tasks);
    }
    features_.release(segment.feature, last);
    pop<choice>(tile, number);
    return true;
}

// For several streams each of which issues from one tile at most.
inline __attribute__((always_inline)) int DrawnBank::issue_oldest() {
    int issued = 0;
    for (; issued < issue_width_; ++issued) {
        const Cycle slot = packet_.next_execution(now_);
        const std::uint32_t found = all_lanes_.least(slot);
        if (found >= DomainLanes::kTop) {
            break;
        }
        const auto lane = static_cast<int>(found & all_lanes_.mask());
        Tile& tile = *lane_tiles_[lane];
        if (!issue_one<Choice::Oldest>(tile, lane - tile.first_lane, slot)) {
            break;
        }
    }
    return issued;
}

} // namespace degs
