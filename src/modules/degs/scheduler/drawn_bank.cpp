// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/drawn_bank.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace degs {

void DrawnBank::run() {
    DatedFifo<Termination>& terminations = *bank_.terminations_;
    for (bool over = bank_.over(); !over;) {
        now_ = self_.local();
        if (!terminations.empty() && terminations.head_date() <= now_) {
            end_pixels();
        }
        if (bank_.contexts_owed_) {
            see_contexts();
        }
        accept();
        const int issued = issue();
        if (bank_.closing_ != 0) {
            finish_tiles();
        }
        over = bank_.over();
        if (open() && next_slot_ - latency_ <= now_) {
            send_part(idle_cause());
        }
        Cycle next = now_ + 1;
        if (over) {
            next = open() ? std::max(next_slot_ - latency_, next) : next;
        } else if (issued == 0 && !(left_ > 0 && free_ != nullptr)) {
            next = next_date();
        } // else work is left, whatever arrives
        close_cycles(next);
        self_.advance_to(next);
    }
    now_ = self_.local();
    if (open()) {
        send_part(Slot::Starved);
    }
    if (bank_.config_.granted) {
        packing_.end_tile(self_, kNoTile, 0);
    }
    self_.finish();
}

// Intake.

inline __attribute__((always_inline)) void DrawnBank::accept() {
    spans_left_ = spans_per_cycle_;
    features_full_ = false;
    for (int budget = segments_per_cycle_; budget > 0; --budget) {
        if (left_ <= 0 && !open_span()) {
            break;
        }
        if (!cut_segment()) {
            break;
        }
    }
}

// Ends of tiles on the way cost nothing.
inline __attribute__((always_inline)) bool DrawnBank::open_span() {
    if (spans_left_ == 0) {
        return false;
    }
    while (takes() && arrived()) {
        const DrawnSpans::Span& span = spans_.front();
        const bool row = !span.end;
        if (row && !features_.admit(span.tile, span.splat, now_)) {
            features_full_ = true;
            return false;
        }
        const TileNumber number = span.tile;
        if (!stream_.entered && number != kNoTile) {
            enter_tile(number);
        }
        if (row) {
            const int domain = bank_.segmenter_.domain_of(span.row, span.drawn.x0);
            cut_ = tile_at(stream_.entering).first + domain;
            column_ = bank_.segmenter_.domains()[domain].column;
            low_ = std::uint64_t{1} << (span.drawn.x0 - column_);
            left_ = span.drawn.x0 + span.drawn.length - column_;
            drawn_ = span.drawn;
            bank_.stats_.spans++;
            bank_.stats_.tasks_in += span.drawn.length;
            --spans_left_;
        }
        spans_.drop(now_);
        if (row) {
            return true;
        }
        ++input_.turn;
        bank_.take_end(stream_, number, now_);
    }
    return false;
}

// False if the queue has no room; the segment is then cut later.
inline __attribute__((always_inline)) bool DrawnBank::cut_segment() {
    Place& place = places_[cut_];
    const std::uint64_t high = std::uint64_t{1} << std::min(left_, segment_length_);
    const auto mask = static_cast<std::uint32_t>(high - low_);
    if ((mask & place.live) == 0) {
        bank_.drop(mask);
    } else {
        Waiting* const segment = free_;
        if (segment == nullptr) {
            return false;
        }
        free_ = segment->next;
        segment->mask = mask;
        segment->inside = static_cast<std::uint32_t>(drawn_.inside >> column_);
        segment->useful = static_cast<std::uint32_t>(drawn_.useful >> column_);
        segment->ended = static_cast<std::uint32_t>(drawn_.ended >> column_);
        segment->next = nullptr;
        segment->feature = features_.current();
        features_.hold(segment->feature);
        *place.end = segment;
        place.end = &segment->next;
        occupied_ |= std::uint64_t{1} << cut_;
        if (++size_ > bank_.stats_.queue_high_water) {
            bank_.stats_.queue_high_water = size_;
        }
    }
    column_ += segment_length_;
    left_ -= segment_length_;
    low_ = 1;
    ++cut_;
    return true;
}

// Issue.

// The older tile goes first, and in it the first place behind the one that issued last. Returns the number of
// segments issued.
inline __attribute__((always_inline)) int DrawnBank::issue() {
    no_room_ = false;
    int issued = 0;
    for (Tile* const tile : started_) {
        while ((occupied_ & tile->places) != 0) {
            const Cycle slot = next_execution();
            const std::uint64_t ready = occupied_ & tile->places & ~cooling_.at(slot);
            if (ready == 0) {
                break;
            }
            const std::uint64_t later = ready & tile->later;
            const int number = __builtin_ctzll(later != 0 ? later : ready);
            tile->later = ~std::uint64_t{1} << number;
            if (!issue_one(number, slot)) {
                break;
            }
            if (++issued == issue_width_) {
                width_limited_ = true;
                bank_.stats_.busy++;
                return issued;
            }
        }
    }
    width_limited_ = false;
    bank_.stats_.busy += issued != 0 ? 1 : 0;
    return issued;
}

// False if the Packing Buffer has no room.
inline __attribute__((always_inline)) bool DrawnBank::issue_one(int number, Cycle slot) {
    Place& place = places_[number];
    const Waiting& segment = *place.head;
    std::uint32_t tasks = segment.mask;
    if ((tasks & ~place.live) != 0) {
        tasks = tasks_of(segment, place.live);
    }
    const int count = __builtin_popcount(tasks);
    if ((slot - (now_ + latency_)) * width_ + (tasks_ + count) > capacity_) {
        no_room_ = true;
        return false;
    }
    Cycle last = now_;
    if (count != 0) {
        last = pack(number, segment, tasks, count, slot);
        slice_.check_drawn(static_cast<std::int32_t>(slot) - place.executed, count);
        place.executed = static_cast<std::int32_t>(last);
        last += reuse_;
        cooling_.cool(number, last);
    }
    bank_.stats_.segments_issued++;
    bank_.stats_.tasks_issued += count;
    bank_.stats_.tasks_dropped += __builtin_popcount(segment.mask ^ tasks);
    features_.release(segment.feature, last);
    pop(number);
    return true;
}

// Returns the execution date of the last task.
inline __attribute__((always_inline)) Cycle
DrawnBank::pack(int number, const Waiting& segment, std::uint32_t tasks, int count, Cycle slot) {
    if (!open()) {
        if (idle_pending_ && slot > next_slot_) {
            settle_idle();
        }
        next_slot_ = slot;
    }
    slice_.count_drawn(tasks, segment.inside, segment.useful);
    if ((tasks & segment.ended) != 0) {
        return end_drawn(number, segment, tasks);
    }
    tasks_ += count;
    Cycle last = next_slot_;
    while (tasks_ >= width_) {
        last = next_slot_;
        tasks_ -= width_;
        send(width_);
    }
    return tasks_ != 0 ? next_slot_ : last;
}

// Dates.

inline __attribute__((always_inline)) void DrawnBank::close_cycles(Cycle until) {
    if (!open() && next_slot_ != 0 && until + latency_ > next_slot_) {
        packing_.since_last_[idle_cause()] += (until + latency_ - next_execution()) * width_;
        idle_pending_ = true;
    }
}

} // namespace degs
