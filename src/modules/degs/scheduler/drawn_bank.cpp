// SPDX-License-Identifier: Apache-2.0
// The cycle of a bank of drawn tasks, and its intake.
#include "modules/degs/scheduler/drawn_bank_issue.hpp"

#include <algorithm>

namespace degs {

void DrawnBank::run() {
    if (spans_ != nullptr) {
        run_cycles<Intake::Single>();
    } else if (streams_.front().inputs.front().spans != nullptr) {
        run_cycles<Intake::Drawn>();
    } else {
        run_cycles<Intake::Rings>();
    }
    finish();
}

template <DrawnBank::Intake intake>
void DrawnBank::run_cycles() {
    switch (choice_) {
    case Choice::InTurn:
        run_cycles<intake, Choice::InTurn>();
        break;
    case Choice::Keyed:
        run_cycles<intake, Choice::Keyed>();
        break;
    case Choice::Oldest:
        if constexpr (intake != Intake::Single) {
            run_cycles<intake, Choice::Oldest>();
        }
        break;
    }
}

// The pixels of the span's next segment.
inline std::uint32_t DrawnBank::cut_mask() const {
    const std::uint64_t high = std::uint64_t{1} << std::min(left_, segment_length_);
    return static_cast<std::uint32_t>(high - low_);
}

// See IssueBank::can_cut().
inline bool DrawnBank::can_cut() const {
    return left_ > 0 && (free_ != nullptr || (cut_mask() & cut_tile_->domains[cut_].live) == 0);
}

template <DrawnBank::Intake intake, DrawnBank::Choice choice>
void DrawnBank::run_cycles() {
    for (bool over = this->over(); !over;) {
        now_ = self_.local();
        if (!terminations_.empty() && terminations_.head_date() <= now_) {
            end_pixels();
        }
        if (contexts_owed_ && now_ >= contexts_from_) {
            see_contexts();
        }
        accept<intake, choice>();
        const bool issued = issue<intake, choice>() != 0;
        if (closing_ != 0) {
            finish_tiles();
            over = this->over();
        }
        const bool works = issued || can_cut();
        if (!works) {
            over = this->over(); // if it became so elsewhere, there is nothing left to do
        }
        if (packet_.due(now_)) {
            send_part(idle_cause());
        }
        Cycle next = now_ + 1;
        if (over) {
            const Cycle open = packet_.open_until();
            next = open == kNever ? next : std::max(open, next);
        } else if (!works) {
            next = next_date();
        } // else work is left, whatever arrives
        stats_.busy += issued ? 1 : 0;
        if (packet_.leaves_slots(next)) {
            packing_.count_idle_later(idle_cause(), packet_.left_slots(now_, next));
            idle_pending_ = true;
        }
        self_.advance_to(next);
    }
}

// Intake.

template <DrawnBank::Intake intake, DrawnBank::Choice choice>
inline __attribute__((always_inline)) void DrawnBank::accept() {
    features_full_ = false;
    int spans = spans_per_cycle_;
    for (int budget = segments_per_cycle_; budget > 0; --budget) {
        if (left_ <= 0 && (spans-- == 0 || !open_span<intake>())) {
            break;
        }
        if (!cut_segment<choice>()) {
            break;
        }
    }
}

// The stream, which has no span to take now, has none before this date, as long as its tiles stay
// as they are.
inline __attribute__((always_inline)) Cycle DrawnBank::next_span_from(const BankStream& stream) {
    const BankStream::Input& input = stream.inputs.front();
    if (!takes(stream, input)) {
        return kNever;
    }
    const DrawnSpans& spans = *input.spans;
    return spans.empty() ? spans.quiet_until() : spans.head_date();
}

// Takes a span of the next stream that has one, in turn; a span cut halfway is finished first.
template <DrawnBank::Intake intake>
inline __attribute__((always_inline)) bool DrawnBank::open_span() {
    if constexpr (intake == Intake::Single) {
        return take_from<intake>(streams_.front());
    }
    if (intake == Intake::Drawn && now_ < spans_from_) {
        return false;
    }
    BankStream* const first = next_stream_;
    Cycle from = kNever;
    do {
        BankStream& stream = *next_stream_;
        next_stream_ = stream.next;
        if (take_from<intake>(stream)) {
            return true;
        }
        if constexpr (intake == Intake::Drawn) {
            from = std::min(from, next_span_from(stream));
        }
    } while (next_stream_ != first);
    spans_from_ = from;
    return false;
}

template <DrawnBank::Intake intake>
inline __attribute__((always_inline)) DrawnSpans&
DrawnBank::spans_of(const BankStream::Input& input) const {
    return intake == Intake::Single ? *spans_ : *input.spans;
}

// The one whose item has arrived first, ties by input; nullptr: none may be taken.
template <DrawnBank::Intake intake>
inline __attribute__((always_inline)) BankStream::Input*
DrawnBank::earliest_input(BankStream& stream) {
    if (!stream.enterable) {
        return nullptr;
    }
    if constexpr (intake != Intake::Rings) {
        BankStream::Input& only = stream.inputs.front();
        return only.turn == stream.entering && arrived(spans_of<intake>(only)) ? &only : nullptr;
    }
    if (stream.inputs.size() == 1) {
        BankStream::Input& only = stream.inputs.front();
        return only.turn == stream.entering && arrived(*only.ring) ? &only : nullptr;
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

template <class Row>
inline __attribute__((always_inline)) void DrawnBank::start(const BankStream& stream, int row,
                                                            const Row& drawn) {
    cut_tile_ = own_[stream.index].entering;
    const Segmenter::Place place = segmenter_.place_of(drawn.x0);
    cut_ = segmenter_.first_domain_of(row) + place.segment;
    column_ = place.column;
    low_ = std::uint64_t{1} << (drawn.x0 - column_);
    left_ = drawn.x0 + drawn.length - column_;
    row_inside_ = &drawn.inside;
    row_ended_ = &drawn.ended;
    stats_.spans++;
    stats_.tasks_in += drawn.length;
    inside_ += drawn.inside.count();
    useful_ += drawn.useful.count();
}

// False if no span of the stream may be taken. Ends of tiles on the way cost nothing.
template <DrawnBank::Intake intake>
inline __attribute__((always_inline)) bool DrawnBank::take_from(BankStream& stream) {
    for (;;) {
        BankStream::Input* const source = earliest_input<intake>(stream);
        if (source == nullptr) {
            return false;
        }
        TileNumber number = kNoTile;
        bool row = false;
        if constexpr (intake != Intake::Rings) {
            DrawnSpans& spans = spans_of<intake>(*source);
            const DrawnSpans::Row& span = spans.front();
            number = span.tile;
            row = !span.end();
            if (row && !admits(stream, number, span.splat)) {
                return false;
            }
            if (!stream.entered && number != kNoTile) {
                enter_tile(stream, number);
            }
            if (row) {
                start(stream, span.row, span);
            }
            spans.drop(now_);
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
                taken_ = item.drawn;
                start(stream, item.span->y, taken_);
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
template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) bool DrawnBank::cut_segment() {
    Domain& domain = cut_tile_->domains[cut_];
    const std::uint32_t mask = cut_mask();
    if ((mask & domain.live) == 0) {
        stats_.drop(mask);
        inside_ -= __builtin_popcount(mask & row_inside_->from(column_));
    } else {
        Waiting* const segment = free_;
        if (segment == nullptr) {
            return false;
        }
        free_ = segment->next;
        segment->mask = mask;
        segment->inside = row_inside_->from(column_);
        segment->ended = row_ended_->from(column_);
        segment->next = nullptr;
        segment->feature = features_.current();
        features_.hold(segment->feature);
        *domain.end = segment;
        domain.end = &segment->next;
        ++cut_tile_->waiting;
        issuable_ += cut_tile_->started ? 1 : 0;
        if (++size_ > stats_.queue_high_water) {
            stats_.queue_high_water = size_;
        }
        DomainLanes& lanes = cut_tile_->lanes;
        if (choice == Choice::InTurn) {
            lanes.set_waiting(cut_, true);
        } else {
            const int first = choice == Choice::Oldest ? cut_tile_->first_lane : 0;
            segment->key = next_key_ | static_cast<std::uint32_t>(first + cut_);
            lanes.set_key(cut_, std::min(lanes.key(cut_), segment->key)); // an older one stays
            if (choice == Choice::Keyed && scan_ == DomainScan::Deepest) {
                lanes.set_length(cut_, ++domain.length);
            }
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

// Packs a segment with whose tasks pixels end.
Cycle DrawnBank::pack_ends(const Tile& tile, int number, std::uint32_t tasks, std::uint32_t ended) {
    Sink<true> sink(*this, tile, number, ended);
    return packet_.pack(now_, tasks, __builtin_popcount(tasks), sink);
}

} // namespace degs
