// SPDX-License-Identifier: Apache-2.0
// What a bank issues into packets. It is inlined in the loop over cycles, so that only
// bank_cycles.cpp includes it.
#pragma once

#include <algorithm>

#include "modules/degs/scheduler/bank_cycles.hpp"

namespace degs {

// Issues segments in this cycle, as the choice says. Returns how many.
template <BankCycles::Kind kind, BankCycles::Intake intake, BankCycles::Choice choice>
inline __attribute__((always_inline)) int BankCycles::issue() {
    no_room_ = false;
    if (issuable_ == 0) {
        width_limited_ = false;
        return 0;
    }
    if constexpr (kind == Kind::General) {
        if (pipeline_.exists()) {
            const int issued = issue_chosen<kind, choice>();
            // What has been chosen and waits for its cycle is limited like what exceeds the width.
            width_limited_ = issued == issue_width_ || (!pipeline_.empty() && !no_room_);
            return issued;
        }
    }
    const bool in_order = intake == Intake::Single || (intake == Intake::Rings && single_stream_);
    const int issued = choice == Choice::Oldest ? issue_oldest<kind>()
                       : in_order               ? issue_in_order<kind, choice>()
                                                : issue_from_all<kind, choice>();
    width_limited_ = issued == issue_width_;
    return issued;
}

// A domain of the tile that may execute at `slot`, chosen by the scan rule: what says which of two
// domains goes first, and which it is, see number_of(); kNothing if there is none.
template <BankCycles::Choice choice>
inline __attribute__((always_inline)) std::uint64_t BankCycles::find(const Tile& tile,
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

// The number of the domain that find() has found, whose rank is `rank`.
template <BankCycles::Kind kind, BankCycles::Choice choice>
inline __attribute__((always_inline)) int BankCycles::number_of(const Tile& tile,
                                                                std::uint64_t rank) const {
    const auto found = static_cast<std::uint32_t>(rank);
    const bool in_turn = choice == Choice::InTurn || scan_ == DomainScan::RoundRobin;
    if (kind == Kind::General && !in_turn && !keys_name_domains()) {
        return tile.lanes.domain_of(found);
    }
    return static_cast<int>(in_turn ? found : found & key_mask_);
}

// For a single stream: one segment after the other, each for the date at which its first task will
// execute. Nothing overtakes what waits for room.
template <BankCycles::Kind kind, BankCycles::Choice choice>
inline __attribute__((always_inline)) int BankCycles::issue_in_order() {
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
        const int number = number_of<kind, choice>(tile, found);
        if (!issue_one<kind, choice>(tile, number, slot)) {
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
template <BankCycles::Choice choice>
inline __attribute__((always_inline)) bool BankCycles::find_ready(std::size_t number, Cycle slot) {
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
template <BankCycles::Choice choice>
inline __attribute__((always_inline)) std::size_t BankCycles::first_ready(Cycle slot) {
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
template <BankCycles::Choice choice>
inline __attribute__((always_inline)) std::size_t BankCycles::least_ready(Cycle slot) {
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

// The stream that issues next by the scan rule; if none has a ready domain, their number. `anew`:
// another domain may be ready than before.
template <BankCycles::Choice choice>
inline __attribute__((always_inline)) std::size_t BankCycles::next_stream(Cycle slot, bool anew) {
    if (choice == Choice::InTurn || scan_ == DomainScan::RoundRobin) {
        return first_ready<choice>(slot);
    }
    if (anew) {
        for (Stream& ready : own_) {
            ready.rank = kNothing;
        }
    }
    return least_ready<choice>(slot);
}

// Issues like issue_in_order(), but from several streams.
template <BankCycles::Kind kind, BankCycles::Choice choice>
inline __attribute__((always_inline)) int BankCycles::issue_from_all() {
    int issued = 0;
    for (Cycle date = 0; issued < issue_width_; ++issued) {
        const Cycle slot = packet_.next_execution(now_);
        const std::size_t chosen = next_stream<choice>(slot, slot != date);
        date = slot;
        if (chosen == own_.size()) {
            break;
        }
        Stream& ready = own_[chosen];
        const int number = number_of<kind, choice>(*ready.tile, ready.rank);
        if (!issue_one<kind, choice>(*ready.tile, number, slot)) {
            break;
        }
        ready.tile->cursor = after(number);
        ready.rank = kNothing;
        issued_stream_ = chosen;
    }
    return issued;
}

// Issues from several streams, each of which has at most one tile that may issue.
template <BankCycles::Kind kind>
inline __attribute__((always_inline)) int BankCycles::issue_oldest() {
    int issued = 0;
    for (; issued < issue_width_; ++issued) {
        const Cycle slot = packet_.next_execution(now_);
        const std::uint32_t found = all_lanes_.least(slot);
        if (found >= DomainLanes::kTop) {
            break;
        }
        const auto lane = static_cast<int>(found & key_mask_);
        Tile& tile = *lane_tiles_[lane];
        if (!issue_one<kind, Choice::Oldest>(tile, lane - tile.first_lane, slot)) {
            break;
        }
    }
    return issued;
}

// Packs the oldest group of a bank with select_cycles. What finds no room keeps what was chosen
// after it where it is.
template <BankCycles::Kind kind, BankCycles::Choice choice>
int BankCycles::issue_chosen() {
    int issued = 0;
    while (const PickPipeline::Pick* const pick = pipeline_.front()) {
        Tile& tile = tile_at(pick->stream, pick->turn);
        const int number = pick->domain;
        if (!issue_one<kind, choice>(tile, number, packet_.next_execution(now_))) {
            break;
        }
        tile.domains[number].held = 0;
        pipeline_.pop();
        ++issued;
    }
    return issued;
}

// The last action of a cycle in a bank with select_cycles: chooses the next group, for the first
// execution date of the next cycle as far as it is known. Nothing is chosen while the oldest group
// waits for room.
template <BankCycles::Choice choice>
void BankCycles::choose() {
    if (pipeline_.front() != nullptr) {
        return;
    }
    pipeline_.shift();
    const Cycle slot = packet_.next_execution(now_ + 1);
    for (int picks = 0; picks < issue_width_; ++picks) {
        const std::size_t chosen = next_stream<choice>(slot, picks == 0);
        if (chosen == own_.size()) {
            return;
        }
        Stream& ready = own_[chosen];
        Tile& tile = *ready.tile;
        const int number = number_of<Kind::General, choice>(tile, ready.rank);
        const BankStream& stream = streams_[chosen];
        std::size_t turn = stream.oldest;
        while (&tile_at(chosen, turn) != &tile) {
            ++turn;
        }
        pipeline_.add({chosen, turn, number});
        tile.domains[number].held = 1;
        if (choice == Choice::InTurn) {
            tile.lanes.set_waiting(number, false);
        } else {
            tile.lanes.set_key(number, DomainLanes::kTop);
            if (scan_ == DomainScan::Deepest) {
                tile.lanes.set_length(number, 0);
            }
        }
        tile.cursor = after(number);
        ready.rank = kNothing;
        issued_stream_ = chosen;
    }
}

/// Counts tasks. Which of them go into a packet matters only if a pixel ends with one: `ends`.
template <bool ends>
class BankCycles::Sink {
public:
    Sink(BankCycles& bank, const Tile& tile, int number, std::uint32_t ended)
        : bank_(bank), tile_(tile), number_(number), ended_(ended) {}
    void end_idle() { bank_.packing_.end_idle(); }
    void begin() {}
    int take(std::uint32_t& left, int count, int room, Cycle slot) {
        if constexpr (ends) {
            const std::uint32_t ended = take_lowest(left, count, room) & ended_;
            if (ended != 0) {
                bank_.end_replayed(tile_, number_, ended, slot);
            }
        }
        return std::min(count, room);
    }
    __attribute__((always_inline)) void send(Slot /*none: the packet is full*/) {
        bank_.packing_.send_counted(bank_.now_);
    }

private:
    BankCycles& bank_;
    const Tile& tile_;
    int number_;
    std::uint32_t ended_;
};

// Counts the tasks of a segment into packets. Returns the date at which the last one executes.
inline __attribute__((always_inline)) Cycle BankCycles::count_tasks(const Tile& tile, int number,
                                                                    std::uint32_t tasks, int count,
                                                                    std::uint32_t ended) {
    if (ended != 0) {
        return pack_ends(tile, number, tasks, ended);
    }
    Sink<false> sink(*this, tile, number, 0);
    return packet_.pack(now_, tasks, count, sink);
}

// Issues the next segment of a domain. False if the Packing Buffer has no room.
template <BankCycles::Kind kind, BankCycles::Choice choice>
inline __attribute__((always_inline)) bool BankCycles::issue_one(Tile& tile, int number,
                                                                 Cycle slot) {
    Domain& domain = tile.domains[number];
    const Waiting& segment = *domain.head;
    std::uint32_t tasks = segment.mask;
    if ((tasks & ~domain.live) != 0) {
        tasks = tasks_of(segment, domain.live);
    }
    const int count = __builtin_popcount(tasks);
    Cycle last = now_;
    if (count != 0) {
        if (kind == Kind::Plain || counts_) {
            if (!packet_.fits(now_, slot, count) || !packet_.can_write(now_, count)) {
                no_room_ = true;
                return false;
            }
            last = count_tasks(tile, number, tasks, count, tasks & segment.ended);
        } else {
            const TaskRun run = run_of(tile, number, segment);
            if (!packing_.room(now_, run, count) ||
                !packing_.room_by_ports(now_, run, tasks, segment.feature)) {
                no_room_ = true;
                return false;
            }
            last = packing_.add(self_, run, tasks, segment.feature);
        }
        last += reuse_;
        if (kind == Kind::Plain || scoreboard_) {
            tile.lanes.set_date(number, last);
        }
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

} // namespace degs
