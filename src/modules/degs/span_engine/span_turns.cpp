// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/span_turns.hpp"

#include <algorithm>

namespace degs {
namespace {

// The end of a tile takes no unit's time: up to two leave a lane in one cycle, at its start and in
// the lane's turn, and then what comes next is looked at.
constexpr std::size_t kItemsOfEnds = 3;

} // namespace

SpanTurns::SpanTurns(Process& unit, const std::vector<SpanReplay*>& streams, TileEnd& tiles)
    : unit_(unit), tiles_(tiles), streams_(streams.size()), next_(streams_.data()) {
    std::vector<FifoBase*> lanes;
    for (std::size_t i = 0; i < streams.size(); ++i) {
        streams_[i].spans = streams[i];
        streams_[i].next = &streams_[(i + 1) % streams.size()];
        streams[i]->take_with(*this);
        streams[i]->reader()->ask_writers();
        lanes.push_back(&streams[i]->lane());
    }
    unit_.pump_asked(*this, lanes);
    unit_.rest();
}

void SpanTurns::run() {
    while (!tiles_.over()) {
        unit_.sleep_to_date();
        pump();
    }
}

// Until somebody else runs or the bank has taken something, another question has the same answer.
Cycle SpanTurns::ask() {
    wanted_ = true;
    const std::uint64_t now = unit_.activation();
    if (!tiles_.over() && (now == 0 || asked_at_ != now + 1)) {
        asked_at_ = now + 1;
        go_on();
    }
    return due_;
}

void SpanTurns::pump() {
    if (!working_ && !tiles_.over()) {
        go_on();
        if (wanted_) {
            unit_.tell();
        }
    }
}

// Whoever is woken here does not run before this is over: banks and Slicing Units have threads.
void SpanTurns::go_on() {
    working_ = true;
    for (Stream& stream : streams_) {
        look_at(stream);
    }
    Stream* changed = &streams_.front();
    for (Cycle date = next_known(changed); date != kNever; date = next_known(changed)) {
        unit_.go();
        unit_.advance_to(date);
        changed = take(date);
        if (tiles_.over()) {
            unit_.finish();
            due_ = kNever;
            break;
        }
        unit_.advance_to(date + 1);
        // An end that has to be sent is in no lane, so that the date alone says when that may be.
        if (ending_ == 0) {
            unit_.rest();
        }
    }
    working_ = false;
}

// Returns the next date at which there is something to do, or kNever if it is not known what the
// unit does then. `changed` is the only stream whose lane or ring is not as it was seen last.
inline __attribute__((always_inline)) Cycle SpanTurns::next_known(Stream* changed) {
    look_at(*changed);
    due_ = kNever;
    for (const Stream& stream : streams_) {
        due_ = std::min(due_, stream.from);
    }
    unknown_ = nullptr;
    if (due_ == kNever) {
        return kNever;
    }
    const Cycle date = std::max(due_, unit_.local());
    due_ = date;
    for (const Stream& stream : streams_) {
        if (const Missing what = missing(stream, date); what != Missing::Nothing) {
            wait_for(*stream.spans, what, date);
            return kNever;
        }
    }
    return date;
}

inline __attribute__((always_inline)) void SpanTurns::look_at(Stream& stream) {
    const SpanReplay& spans = *stream.spans;
    stream.ends = stream.ending;
    stream.from = kNever;
    if (stream.ending) {
        stream.from = spans.full() ? kNever : spans.room_date();
    } else if (spans.waiting() != 0) {
        stream.ends = spans.next_ends();
        stream.from = stream.ends    ? spans.lane_head()
                      : spans.full() ? kNever
                                     : std::max(spans.lane_head(), spans.room_date());
    }
}

// Says what is not certain about the stream at `date`, up to which it has nothing to do.
inline __attribute__((always_inline)) SpanTurns::Missing SpanTurns::missing(const Stream& stream,
                                                                            Cycle date) const {
    SpanReplay& spans = *stream.spans;
    if (stream.from <= date) {
        return stream.ends ? missing_of_ends(spans, date) : Missing::Nothing;
    }
    if (spans.waiting() == 0 && !stream.ending) {
        return is_quiet(spans, date) ? Missing::Nothing : Missing::Item;
    }
    const bool sure = stream.from != kNever || (!stream.ending && spans.lane_head() > date) ||
                      stays_full(spans, date);
    return sure ? Missing::Nothing : Missing::Room;
}

SpanTurns::Missing SpanTurns::missing_of_ends(SpanReplay& spans, Cycle date) const {
    if (spans.waiting() < kItemsOfEnds && !is_quiet(spans, date)) {
        return Missing::Item;
    }
    return spans.room() >= kItemsOfEnds || stays_full(spans, date) ? Missing::Nothing
                                                                   : Missing::Room;
}

// True if nothing that is not in the lane yet can be taken at `date`.
inline bool SpanTurns::is_quiet(SpanReplay& spans, Cycle date) const {
    return unit_.quiet_beyond(spans.lane(), date) || unit_.certain(date);
}

// True if no place of the crossbar becomes free up to `date`. What kernel time says holds unless
// the bank, which may sleep since before, acts on what it has been sent meanwhile.
bool SpanTurns::stays_full(const SpanReplay& spans, Cycle date) const {
    return Process::full_beyond(spans, date) ||
           (unit_.certain(date) && spans.reader()->next_action() + spans.release_latency() > date);
}

// Somebody who waits for the unit has it go on as soon as that is possible. A bank that sleeps
// wakes when kernel time says what comes; a Slicing Unit that has no place does not.
void SpanTurns::wait_for(SpanReplay& spans, Missing what, Cycle date) {
    unknown_ = what == Missing::Item ? &spans : nullptr;
    asked_at_ = what == Missing::Item ? asked_at_ : 0;
    const bool full = std::any_of(streams_.begin(), streams_.end(),
                                  [](const Stream& s) { return s.spans->lane().full(); });
    if (!wanted_ && !full) {
        return;
    }
    if (what == Missing::Item) {
        spans.lane().writer()->set_alarm(spans.lane(), date);
    } else if (spans.full()) {
        spans.reader()->set_room_alarm(spans, date);
    }
    if (spans.reader()->blocked()) {
        spans.reader()->wake_at(date + spans.forward_latency());
    }
    if (full) {
        unit_.wake_at(date);
    }
}

// See SpanPool::take_rows(). Returns a stream whose row has been taken, or any.
inline __attribute__((always_inline)) SpanTurns::Stream* SpanTurns::take(Cycle date) {
    for (const Stream& stream : streams_) {
        if (stream.ends && stream.from <= date) {
            pass_ends(date);
            break;
        }
    }
    Stream* const first = next_;
    do {
        Stream& stream = *next_;
        next_ = stream.next;
        if (stream.from <= date && stream.ends) {
            pass_end(stream, date);
        }
        if (stream.from <= date && !stream.ends) {
            SpanReplay& spans = *stream.spans;
            const bool was_empty = spans.empty();
            spans.take_row(date);
            sent(spans, was_empty);
            return &stream;
        }
    } while (next_ != first);
    return first;
}

// Passes on the ends of tiles that come at the start of the cycle.
void SpanTurns::pass_ends(Cycle date) {
    for (Stream& stream : streams_) {
        if (stream.ends && stream.from <= date) {
            pass_end(stream, date);
        }
    }
}

// See SpanPool::look_at().
void SpanTurns::pass_end(Stream& stream, Cycle date) {
    SpanReplay& spans = *stream.spans;
    if (!stream.ending) {
        stream.end_number = spans.leave(date);
        stream.ending = true;
        ++ending_;
    }
    if (!spans.full() && spans.room_date() <= date) {
        stream.ending = false;
        --ending_;
        tiles_.count(spans.tile_of(stream.end_number));
        const bool was_empty = spans.empty();
        spans.send(stream.end_number, date);
        sent(spans, was_empty);
    }
    look_at(stream);
}

// Notes that a bank, if it slept, has been woken by the span: it asks again if it wants more.
inline __attribute__((always_inline)) void SpanTurns::sent(const SpanReplay& spans,
                                                           bool was_empty) {
    if (was_empty && !spans.empty() && spans.reader()->blocked()) {
        wanted_ = false;
    }
}

} // namespace degs
