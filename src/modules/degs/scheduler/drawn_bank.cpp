// SPDX-License-Identifier: Apache-2.0
// The cycle of a bank of drawn tasks, its intake, and what it issues into packets.
#include "modules/degs/scheduler/drawn_bank.hpp"

#include <algorithm>

namespace degs {

void DrawnBank::run() {
    const bool in_turn = scan_ == DomainScan::RoundRobin;
    if (spans_ != nullptr) {
        in_turn ? run_cycles<true, true>() : run_cycles<true, false>();
    } else {
        in_turn ? run_cycles<false, true>() : run_cycles<false, false>();
    }
    finish();
}

template <bool single, bool in_turn>
void DrawnBank::run_cycles() {
    for (bool over = this->over(); !over;) {
        now_ = self_.local();
        if (!terminations_.empty() && terminations_.head_date() <= now_) {
            end_pixels();
        }
        if (contexts_owed_) {
            see_contexts();
        }
        accept<single, in_turn>();
        const int issued = issue<single, in_turn>();
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
}

// Intake.

template <bool single, bool in_turn>
inline __attribute__((always_inline)) void DrawnBank::accept() {
    features_full_ = false;
    int spans = spans_per_cycle_;
    for (int budget = segments_per_cycle_; budget > 0; --budget) {
        if (left_ <= 0 && (spans-- == 0 || !open_span<single>())) {
            break;
        }
        if (!cut_segment<in_turn>()) {
            break;
        }
    }
}

// Takes a span of the next stream that has one, in turn; a span cut halfway is finished first.
template <bool single>
inline __attribute__((always_inline)) bool DrawnBank::open_span() {
    if constexpr (single) {
        return take_from<single>(streams_.front());
    }
    BankStream* const first = next_stream_;
    do {
        BankStream& stream = *next_stream_;
        next_stream_ = stream.next;
        if (take_from<single>(stream)) {
            return true;
        }
    } while (next_stream_ != first);
    return false;
}

// The one whose item has arrived first, ties by input; nullptr: none may be taken.
template <bool single>
inline __attribute__((always_inline)) BankStream::Input*
DrawnBank::earliest_input(BankStream& stream) {
    if constexpr (single) {
        BankStream::Input& only = stream.inputs.front();
        return takes(stream, only) && arrived(*spans_) ? &only : nullptr;
    }
    if (!stream.enterable) {
        return nullptr;
    }
    BankStream::Input* source = nullptr;
    Cycle earliest = kNever;
    for (BankStream::Input& input : stream.inputs) {
        if (input.turn == stream.entering && arrived(*input.ring) &&
            input.ring->head_date() < earliest) {
            earliest = input.ring->head_date();
            source = &input;
        }
    }
    return source;
}

// False if the span has to wait for the parameters of its splat.
inline __attribute__((always_inline)) bool
DrawnBank::admits(const BankStream& stream, TileNumber number, std::uint32_t splat) {
    if (!features_.admit(number, splat, now_, stream.index)) {
        features_full_ = true;
        return false;
    }
    return !fills_ || features_.filled_by(packet_.next_execution(now_));
}

inline __attribute__((always_inline)) void DrawnBank::start(const BankStream& stream, int row,
                                                            const DrawnRow& drawn) {
    cut_tile_ = own_[stream.index].entering;
    cut_ = segmenter_.domain_of(row, drawn.x0);
    column_ = segmenter_.domains()[cut_].column;
    low_ = std::uint64_t{1} << (drawn.x0 - column_);
    left_ = drawn.x0 + drawn.length - column_;
    drawn_ = drawn;
    stats_.spans++;
    stats_.tasks_in += drawn.length;
    inside_ += __builtin_popcountll(drawn.inside);
    useful_ += __builtin_popcountll(drawn.useful);
}

// False if no span of the stream may be taken. Ends of tiles on the way cost nothing.
template <bool single>
inline __attribute__((always_inline)) bool DrawnBank::take_from(BankStream& stream) {
    for (;;) {
        BankStream::Input* const source = earliest_input<single>(stream);
        if (source == nullptr) {
            return false;
        }
        TileNumber number = kNoTile;
        bool row = false;
        if constexpr (single) {
            const DrawnSpans::Span& span = spans_->front();
            number = span.tile;
            row = !span.end;
            if (row && !admits(stream, number, span.splat)) {
                return false;
            }
            if (!stream.entered && number != kNoTile) {
                enter_tile(stream, number);
            }
            if (row) {
                start(stream, span.row, span.drawn);
            }
            spans_->drop(now_);
        } else {
            const SpanItem& item = source->ring->front();
            number = item.tile;
            row = item.span.has_value();
            if (row && !admits(stream, number, item.span->splat)) {
                return false;
            }
            if (!stream.entered && number != kNoTile) {
                enter_tile(stream, number);
            }
            if (row) {
                start(stream, item.span->y, item.drawn);
            }
            source->ring->drop(self_);
        }
        if (row) {
            return true;
        }
        ++source->turn;
        take_end(stream, number);
    }
}

// False if the queue has no room; the segment is then cut later.
template <bool in_turn>
inline __attribute__((always_inline)) bool DrawnBank::cut_segment() {
    Domain& domain = cut_tile_->domains[cut_];
    const std::uint64_t high = std::uint64_t{1} << std::min(left_, segment_length_);
    const auto mask = static_cast<std::uint32_t>(high - low_);
    if ((mask & domain.live) == 0) {
        stats_.drop(mask);
        inside_ -= __builtin_popcount(mask & static_cast<std::uint32_t>(drawn_.inside >> column_));
    } else {
        Waiting* const segment = free_;
        if (segment == nullptr) {
            return false;
        }
        free_ = segment->next;
        segment->mask = mask;
        segment->inside = static_cast<std::uint32_t>(drawn_.inside >> column_);
        segment->ended = static_cast<std::uint32_t>(drawn_.ended >> column_);
        segment->key = next_key_ | static_cast<std::uint32_t>(cut_);
        segment->next = nullptr;
        segment->feature = features_.current();
        features_.hold(segment->feature);
        *domain.end = segment;
        domain.end = &segment->next;
        DomainLanes& lanes = cut_tile_->lanes;
        lanes.set_key(cut_, in_turn
                                ? segment->key
                                : std::min(lanes.key(cut_), segment->key)); // an older one stays
        if (!in_turn && scan_ == DomainScan::Deepest) {
            lanes.set_length(cut_, ++domain.length);
        }
        ++cut_tile_->waiting;
        issuable_ += cut_tile_->started ? 1 : 0;
        if (++size_ > stats_.queue_high_water) {
            stats_.queue_high_water = size_;
        }
        if (!in_turn) {
            next_key_ += key_step_;
            if (next_key_ >= DomainLanes::kTop) {
                renumber();
            }
        }
    }
    ++segments_in_;
    column_ += segment_length_;
    left_ -= segment_length_;
    low_ = 1;
    ++cut_;
    return true;
}

// Issue. Returns the number of segments issued.

template <bool single, bool in_turn>
inline __attribute__((always_inline)) int DrawnBank::issue() {
    no_room_ = false;
    if (issuable_ == 0) {
        width_limited_ = false;
        return 0;
    }
    const int issued =
        single || single_stream_ ? issue_in_order<in_turn>() : issue_from_all<in_turn>();
    width_limited_ = issued == issue_width_;
    stats_.busy += issued != 0 ? 1 : 0;
    return issued;
}

// A domain of the tile that may execute at `slot`, chosen by the scan rule: its number below what
// makes one of two domains go first; kNothing if there is none.
template <bool in_turn>
inline __attribute__((always_inline)) std::uint64_t DrawnBank::find(const Tile& tile,
                                                                    Cycle slot) const {
    if (!in_turn && scan_ == DomainScan::Deepest) {
        return tile.lanes.longest(slot);
    }
    const std::uint32_t found =
        in_turn ? tile.lanes.next_from(tile.cursor, slot) : tile.lanes.least(slot);
    return found >= DomainLanes::kTop ? kNothing : found;
}

// The older tile goes first.
template <bool in_turn>
inline __attribute__((always_inline)) int DrawnBank::issue_in_order() {
    int issued = 0;
    for (Tile* const tile : started_) {
        while (tile->waiting != 0) {
            const Cycle slot = packet_.next_execution(now_);
            const std::uint64_t found = find<in_turn>(*tile, slot);
            if (found == kNothing) {
                break;
            }
            const auto number = static_cast<int>(found & tile->lanes.mask());
            tile->cursor = after(number);
            if (!issue_one<in_turn>(*tile, number, slot)) {
                break;
            }
            if (++issued == issue_width_) {
                return issued;
            }
        }
    }
    return issued;
}

// Looks for a domain of the stream that may issue, in its oldest tile that has one. False if there
// is none.
template <bool in_turn>
inline __attribute__((always_inline)) bool DrawnBank::find_ready(const BankStream& stream,
                                                                 Cycle slot) {
    Stream& ready = own_[stream.index];
    if (ready.rank != kNothing) {
        return true;
    }
    Tile* const* const end = started_.data() + stream.end_started;
    for (Tile* const* place = started_.data() + stream.first_started; place != end; ++place) {
        Tile& tile = **place;
        if (tile.waiting == 0) {
            continue;
        }
        const std::uint64_t rank = find<in_turn>(tile, slot);
        if (rank != kNothing) {
            ready.tile = &tile;
            ready.rank = rank;
            return true;
        }
    }
    return false;
}

// The next stream that has a ready domain, that which issued last at the end; if there is none,
// their number. All streams are searched, because what they have at this date counts for later
// issues of the cycle; for the `last` one only as far as needed.
template <bool in_turn>
std::size_t DrawnBank::first_ready(Cycle slot, bool last) {
    std::size_t first = streams_.size();
    std::size_t stream = issued_stream_;
    do {
        stream = streams_[stream].next->index;
        if (find_ready<in_turn>(streams_[stream], slot) && first == streams_.size()) {
            first = stream;
        }
    } while (stream != issued_stream_ && (first == streams_.size() || !last));
    return first;
}

// The stream whose ready domain goes first; if there is none, their number.
template <bool in_turn>
inline __attribute__((always_inline)) std::size_t DrawnBank::least_ready(Cycle slot) {
    std::size_t chosen = streams_.size();
    std::uint64_t least = kNothing;
    for (const BankStream& stream : streams_) {
        find_ready<in_turn>(stream, slot);
        const std::uint64_t rank = own_[stream.index].rank;
        chosen = rank < least ? stream.index : chosen;
        least = std::min(rank, least);
    }
    return chosen;
}

// One of the streams after the other; a domain that was found stays ready until it is issued.
template <bool in_turn>
inline __attribute__((always_inline)) int DrawnBank::issue_from_all() {
    for (Stream& ready : own_) {
        ready.rank = kNothing;
    }
    int issued = 0;
    while (issued < issue_width_) {
        const Cycle slot = packet_.next_execution(now_);
        const bool last = issued + 1 == issue_width_;
        const std::size_t chosen =
            in_turn ? first_ready<in_turn>(slot, last) : least_ready<in_turn>(slot);
        if (chosen == streams_.size()) {
            break;
        }
        Stream& ready = own_[chosen];
        const auto number = static_cast<int>(ready.rank & ready.tile->lanes.mask());
        if (!issue_one<in_turn>(*ready.tile, number, slot)) {
            break; // nothing overtakes what waits for room
        }
        ready.tile->cursor = after(number);
        ready.rank = kNothing;
        issued_stream_ = chosen;
        ++issued;
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

Cycle DrawnBank::pack_ends(const Tile& tile, int number, std::uint32_t tasks, std::uint32_t ended) {
    Sink<true> sink(*this, tile, number, ended);
    return packet_.pack(now_, tasks, __builtin_popcount(tasks), sink);
}

// False if the Packing Buffer has no room.
template <bool in_turn>
inline __attribute__((always_inline)) bool DrawnBank::issue_one(Tile& tile, int number,
                                                                Cycle slot) {
    Domain& domain = tile.domains[number];
    const Waiting& segment = *domain.head;
    std::uint32_t tasks = segment.mask;
    if ((tasks & ~domain.live) != 0) {
        tasks = tasks_of(segment, domain.live);
    }
    const int count = __builtin_popcount(tasks);
    if (!packet_.fits(now_, slot, count)) {
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
    if (tasks != segment.mask) {
        drop(segment, segment.mask ^ tasks);
    }
    features_.release(segment.feature, last);
    pop<in_turn>(tile, number);
    return true;
}

} // namespace degs
