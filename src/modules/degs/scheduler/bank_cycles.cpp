// SPDX-License-Identifier: Apache-2.0
// The loop over the cycles of a bank, and how it takes in spans.
#include "modules/degs/scheduler/bank_cycles_issue.hpp"

#include <algorithm>

namespace degs {

void BankCycles::run() {
    if (counts_ && !pipeline_.exists() && keys_name_domains()) {
        run_from<Kind::Plain>();
    } else {
        run_from<Kind::General>();
    }
    finish();
}

template <BankCycles::Kind kind>
void BankCycles::run_from() {
    if (spans_ != nullptr) {
        run_by<kind, Intake::Single>();
    } else if (streams_.front().inputs.front().spans != nullptr) {
        run_by<kind, Intake::Replayed>();
    } else {
        run_by<kind, Intake::Rings>();
    }
}

template <BankCycles::Kind kind, BankCycles::Intake intake>
void BankCycles::run_by() {
    switch (choice_) {
    case Choice::InTurn:
        run_cycles<kind, intake, Choice::InTurn>();
        break;
    case Choice::Keyed:
        run_cycles<kind, intake, Choice::Keyed>();
        break;
    case Choice::Oldest:
        if constexpr (kind == Kind::Plain && intake != Intake::Single) {
            run_cycles<kind, intake, Choice::Oldest>();
        }
        break;
    }
}

// The mask of the pixels that the next segment of the span has.
inline std::uint32_t BankCycles::cut_mask() const {
    const std::uint64_t high = std::uint64_t{1} << std::min(left_, segment_length_);
    return static_cast<std::uint32_t>(high - low_);
}

// True if another segment of the span can be cut or dropped at once.
inline bool BankCycles::can_cut() const {
    return left_ > 0 && (free_ != nullptr || (cut_mask() & cut_tile_->domains[cut_].live) == 0);
}

template <BankCycles::Kind kind, BankCycles::Intake intake, BankCycles::Choice choice>
void BankCycles::run_cycles() {
    for (bool over = this->over(); !over;) {
        now_ = self_.local();
        if (has_terminations<kind>()) {
            end_pixels();
        }
        if (contexts_owed_ && now_ >= contexts_from_) {
            see_contexts();
        }
        accept<kind, intake, choice>();
        const bool issued = issue<kind, intake, choice>() != 0;
        if (closing_ != 0) {
            finish_tiles();
            over = this->over();
        }
        bool works = issued || can_cut();
        if constexpr (kind == Kind::General) {
            if (pipeline_.exists()) {
                choose<choice>();
                works = works || !pipeline_.empty();
            }
        }
        if (!works) {
            over = this->over(); // if it became so elsewhere, there is nothing left to do
        }
        if (packet_.due(now_)) {
            packing_.send_due(self_, idle_cause());
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
            packing_.close_cycles(self_, next, idle_cause());
        }
        self_.advance_to(next);
    }
}

// Intake.

template <BankCycles::Kind kind, BankCycles::Intake intake, BankCycles::Choice choice>
inline __attribute__((always_inline)) void BankCycles::accept() {
    features_full_ = false;
    int spans = spans_per_cycle_;
    for (int budget = segments_per_cycle_; budget > 0; --budget) {
        if (left_ <= 0 && (spans-- == 0 || !open_span<kind, intake>())) {
            break;
        }
        if (!cut_segment<kind, choice>()) {
            break;
        }
    }
}

// The date before which the stream, which has no span to take now, will have none, as long as its
// tiles stay as they are.
inline __attribute__((always_inline)) Cycle BankCycles::next_span_from(const BankStream& stream) {
    const BankStream::Input& input = stream.inputs.front();
    if (!takes(stream, input)) {
        return kNever;
    }
    const SpanReplay& spans = *input.spans;
    return spans.empty() ? spans.quiet_until() : spans.head_date();
}

// Takes a span of the next stream that has one, in turn; a span cut halfway is finished first.
template <BankCycles::Kind kind, BankCycles::Intake intake>
inline __attribute__((always_inline)) bool BankCycles::open_span() {
    if constexpr (intake == Intake::Single) {
        return take_from<kind, intake>(streams_.front());
    }
    if (intake == Intake::Replayed && now_ < spans_from_) {
        return false;
    }
    BankStream* const first = next_stream_;
    Cycle from = kNever;
    do {
        BankStream& stream = *next_stream_;
        next_stream_ = stream.next;
        if (take_from<kind, intake>(stream)) {
            return true;
        }
        if constexpr (intake == Intake::Replayed) {
            from = std::min(from, next_span_from(stream));
        }
    } while (next_stream_ != first);
    spans_from_ = from;
    return false;
}

template <BankCycles::Intake intake>
inline __attribute__((always_inline)) SpanReplay&
BankCycles::spans_of(const BankStream::Input& input) const {
    return intake == Intake::Single ? *spans_ : *input.spans;
}

// The input of the stream whose item has arrived first; of several, the first input. nullptr if no
// item may be taken.
template <BankCycles::Intake intake>
inline __attribute__((always_inline)) BankStream::Input*
BankCycles::earliest_input(BankStream& stream) {
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

// Asks the Feature Buffer for an entry. False if the span has to wait for its splat's parameters.
inline __attribute__((always_inline)) bool
BankCycles::admits(const BankStream& stream, TileNumber number, std::uint32_t splat) {
    if (!features_.admit(number, splat, now_, stream.index)) {
        features_full_ = true;
        return false;
    }
    return !fills_ || features_.filled_by(packet_.next_execution(now_));
}

inline __attribute__((always_inline)) void BankCycles::start(const BankStream& stream, int row,
                                                             int x0, int length) {
    cut_tile_ = own_[stream.index].entering;
    const Segmenter::Place place = segmenter_.place_of(x0);
    cut_ = segmenter_.first_domain_of(row) + place.segment;
    column_ = place.column;
    low_ = std::uint64_t{1} << (x0 - column_);
    left_ = x0 + length - column_;
    stats_.spans++;
    stats_.tasks_in += length;
}

// Notes where the outcomes of the span that starts are.
template <class Row>
inline __attribute__((always_inline)) void BankCycles::start_replay(const Row& row) {
    row_inside_ = &row.inside;
    row_useful_ = &row.useful;
    row_ended_ = &row.ended;
    inside_ += row.inside.count();
    useful_ += row.useful.count();
}

// Takes the next span of the stream, and the ends of tiles before it, which cost nothing. False if
// no span may be taken.
template <BankCycles::Kind kind, BankCycles::Intake intake>
inline __attribute__((always_inline)) bool BankCycles::take_from(BankStream& stream) {
    for (;;) {
        BankStream::Input* const source = earliest_input<intake>(stream);
        if (source == nullptr) {
            return false;
        }
        TileNumber number = kNoTile;
        bool row = false;
        if constexpr (intake != Intake::Rings) {
            SpanReplay& spans = spans_of<intake>(*source);
            const SpanReplay::Row& span = spans.front();
            number = span.tile;
            row = !span.end();
            if (row && !admits(stream, number, span.splat)) {
                return false;
            }
            if (!stream.entered && number != kNoTile) {
                enter_tile(stream, number);
            }
            if (row) {
                start(stream, span.row, span.x0, span.length);
                start_replay(span);
                if constexpr (kind == Kind::General) {
                    taken_span_.splat = span.splat;
                }
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
                start(stream, item.span->y, item.span->x0, item.span->length);
                if (kind == Kind::Plain || slice_ != nullptr) {
                    taken_ = item.outcome;
                    start_replay(taken_);
                }
                if constexpr (kind == Kind::General) {
                    taken_span_ = *item.span;
                }
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

// Cuts the next segment off the span and queues or drops it. False if the queue has no room; the
// segment is then cut later.
template <BankCycles::Kind kind, BankCycles::Choice choice>
inline __attribute__((always_inline)) bool BankCycles::cut_segment() {
    Domain& domain = cut_tile_->domains[cut_];
    const std::uint32_t mask = cut_mask();
    if ((mask & domain.live) == 0) {
        stats_.drop(mask);
        if (kind == Kind::Plain || slice_ != nullptr) {
            inside_ -= __builtin_popcount(mask & row_inside_->from(column_));
        }
    } else {
        Waiting* const segment = free_;
        if (segment == nullptr) {
            return false;
        }
        free_ = segment->next;
        segment->mask = mask;
        if (kind == Kind::Plain || slice_ != nullptr) {
            segment->inside = row_inside_->from(column_);
            segment->ended = row_ended_->from(column_);
        }
        segment->next = nullptr;
        segment->feature = features_.current();
        features_.hold(segment->feature);
        if constexpr (kind == Kind::General) {
            keep_values(*segment);
        }
        *domain.end = segment;
        domain.end = &segment->next;
        ++cut_tile_->waiting;
        issuable_ += cut_tile_->started ? 1 : 0;
        if (++size_ > stats_.queue_high_water) {
            stats_.queue_high_water = size_;
        }
        list_segment<kind, choice>(*segment, domain);
    }
    ++segments_in_;
    column_ += segment_length_;
    left_ -= segment_length_;
    low_ = 1;
    ++cut_;
    return true;
}

// The newest segment of a domain of the tile that is cut waits. The choice sees nothing of it in a
// domain that has been chosen, until its oldest one is packed.
template <BankCycles::Kind kind, BankCycles::Choice choice>
inline __attribute__((always_inline)) void BankCycles::list_segment(Waiting& segment,
                                                                    Domain& domain) {
    DomainLanes& lanes = cut_tile_->lanes;
    const bool shown = kind == Kind::Plain || domain.held == 0;
    if (choice == Choice::InTurn) {
        if (shown) {
            lanes.set_waiting(cut_, true);
        }
        return;
    }
    const int number = choice == Choice::Oldest ? cut_tile_->first_lane + cut_ : cut_;
    segment.key = next_key_ | (static_cast<std::uint32_t>(number) & key_mask_);
    if (shown) {
        lanes.set_key(cut_, std::min(lanes.key(cut_), segment.key)); // an older one stays
    }
    if (choice == Choice::Keyed && scan_ == DomainScan::Deepest) {
        ++domain.length;
        if (shown) {
            lanes.set_length(cut_, domain.length);
        }
    }
    next_key_ += key_step_;
    if (next_key_ >= DomainLanes::kTop) {
        renumber();
    }
}

// Packs a segment with whose tasks pixels end.
Cycle BankCycles::pack_ends(const Tile& tile, int number, std::uint32_t tasks,
                            std::uint32_t ended) {
    Sink<true> sink(*this, tile, number, ended);
    return packet_.pack(now_, tasks, __builtin_popcount(tasks), sink);
}

} // namespace degs
