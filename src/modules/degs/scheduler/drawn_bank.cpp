// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/drawn_bank.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace degs {

void DrawnBank::run() {
    for (bool over = this->over(); !over;) {
        now_ = self_.local();
        if (!terminations_.empty() && terminations_.head_date() <= now_) {
            end_pixels();
        }
        if (contexts_owed_) {
            see_contexts();
        }
        accept();
        const int issued = issue();
        if (closing_ != 0) {
            finish_tiles();
        }
        over = this->over();
        if (packet_.due(now_)) {
            send_part(idle_cause());
        }
        Cycle next = now_ + 1;
        if (over) {
            const Cycle open = packet_.open_until();
            next = open == kNever ? next : std::max(open, next);
        } else if (issued == 0 && !(left_ > 0 && free_ != nullptr)) {
            next = next_date();
        } // else work is left, whatever arrives
        if (packet_.leaves_slots(next)) {
            packing_.count_idle_later(idle_cause(), packet_.left_slots(now_, next));
            idle_pending_ = true;
        }
        self_.advance_to(next);
    }
    now_ = self_.local();
    if (packet_.open()) {
        send_part(Slot::Starved);
    }
    if (config_.granted) {
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
            const int domain = segmenter_.domain_of(span.row, span.drawn.x0);
            cut_ = tile_at(stream_.entering).first + domain;
            column_ = segmenter_.domains()[domain].column;
            low_ = std::uint64_t{1} << (span.drawn.x0 - column_);
            left_ = span.drawn.x0 + span.drawn.length - column_;
            drawn_ = span.drawn;
            stats_.spans++;
            stats_.tasks_in += span.drawn.length;
            --spans_left_;
        }
        spans_.drop(now_);
        if (row) {
            return true;
        }
        ++input_.turn;
        take_end(number);
    }
    return false;
}

// False if the queue has no room; the segment is then cut later.
inline __attribute__((always_inline)) bool DrawnBank::cut_segment() {
    Place& place = places_[cut_];
    const std::uint64_t high = std::uint64_t{1} << std::min(left_, segment_length_);
    const auto mask = static_cast<std::uint32_t>(high - low_);
    if ((mask & place.live) == 0) {
        stats_.drop(mask);
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
        if (++size_ > stats_.queue_high_water) {
            stats_.queue_high_water = size_;
        }
    }
    column_ += segment_length_;
    left_ -= segment_length_;
    low_ = 1;
    ++cut_;
    return true;
}

// Issue.

// The older tile goes first, and in it the first place behind the one that issued last. Returns the
// number of segments issued.
inline __attribute__((always_inline)) int DrawnBank::issue() {
    no_room_ = false;
    int issued = 0;
    for (Tile* const tile : started_) {
        while ((occupied_ & tile->places) != 0) {
            const Cycle slot = packet_.next_execution(now_);
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
                stats_.busy++;
                return issued;
            }
        }
    }
    width_limited_ = false;
    stats_.busy += issued != 0 ? 1 : 0;
    return issued;
}

/// Counts tasks. Which of them go into a packet matters only if a pixel ends with one: `ends`.
template <bool ends>
class DrawnBank::Sink {
public:
    Sink(DrawnBank& bank, int place, std::uint32_t ended)
        : bank_(bank), place_(place), ended_(ended) {}
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
                bank_.end_drawn(place_, ended, slot);
            }
        }
        return std::min(count, room);
    }
    void send(Slot /*none: the packet is full*/) { bank_.send(); }

private:
    DrawnBank& bank_;
    int place_;
    std::uint32_t ended_;
};

Cycle DrawnBank::pack_ends(int number, std::uint32_t tasks, std::uint32_t ended) {
    Sink<true> sink(*this, number, ended);
    return packet_.pack(now_, tasks, __builtin_popcount(tasks), sink);
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
    if (!packet_.fits(now_, slot, count)) {
        no_room_ = true;
        return false;
    }
    Cycle last = now_;
    if (count != 0) {
        slice_.count_drawn(tasks, segment.inside, segment.useful);
        if (const std::uint32_t ended = tasks & segment.ended; ended != 0) {
            last = pack_ends(number, tasks, ended);
        } else {
            Sink<false> sink(*this, number, 0);
            last = packet_.pack(now_, tasks, count, sink);
        }
        slice_.check_drawn(static_cast<std::int32_t>(slot) - place.executed, count);
        place.executed = static_cast<std::int32_t>(last);
        last += reuse_;
        cooling_.cool(number, last);
    }
    stats_.segments_issued++;
    stats_.tasks_issued += count;
    stats_.tasks_dropped += __builtin_popcount(segment.mask ^ tasks);
    features_.release(segment.feature, last);
    pop(number);
    return true;
}

} // namespace degs
