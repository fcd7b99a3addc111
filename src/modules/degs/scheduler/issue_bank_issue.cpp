// SPDX-License-Identifier: Apache-2.0
// Which segments a bank issues, and the date at which it has something to do again.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "modules/degs/scheduler/issue_bank.hpp"

namespace degs {

// False if the Packing Buffer has no room for the head of the domain. Inlined in the hot loop.
inline __attribute__((always_inline)) bool IssueBank::issue_one(Cycle now, SegmentQueue::Tile& tile,
                                                                int domain) {
    const Segment& segment = tile.front(domain);
    const std::uint32_t mask = segment.run.task.mask;
    std::uint32_t wanted = mask & tile.live(domain);
    if (wanted != mask && by_task_ && wanted != 0) {
        wanted = mask; // one live task takes the others along
    }
    const int tasks = __builtin_popcount(wanted);
    if (!packing_.room(now, segment.run, tasks) ||
        !packing_.room_by_ports(now, segment.run, wanted, segment.feature)) {
        no_room_ = true;
        return false;
    }
    const Cycle slot = packing_.next_execution(now);
    Cycle last = now;
    if (tasks != 0) {
        last = packing_.add(self_, segment.run, wanted, segment.feature) + config_.reuse_cycles;
        if (config_.scoreboard) {
            queue_.set_ready_at(tile, domain, last);
        }
    }
    if (trace_ != nullptr) {
        trace_->add({now, slot, last, tile.context(), domain, wanted});
    }
    stats_.segments_issued++;
    stats_.tasks_issued += tasks;
    stats_.tasks_dropped += __builtin_popcount(mask) - tasks;
    features_.release(segment.feature, last);
    queue_.pop(tile, domain);
    return true;
}

// True if anything was issued.
bool IssueBank::issue(Cycle now) {
    no_room_ = false;
    const int issued = pipeline_.exists() ? issue_chosen(now) : issue_segments(now);
    // What has been chosen and waits for its cycle is limited like what exceeds the width.
    width_limited_ = issued == config_.issue_width || (!pipeline_.empty() && !no_room_);
    stats_.busy += issued != 0 ? 1 : 0;
    return issued != 0;
}

// Picks one segment after the other, each for the date at which its first task will execute.
// Nothing overtakes what waits for room. Returns the number of segments issued.
int IssueBank::issue_segments(Cycle now) {
    int issued = 0;
    for (Cycle date = 0; issued < config_.issue_width; ++issued) {
        const Cycle slot = packing_.next_execution(now);
        if (slot != date) { // another domain may be ready now
            date = slot;
            for (BankStream& stream : streams_) {
                stream.ready = -1;
            }
        }
        BankStream* const chosen = choose_stream(slot);
        if (chosen == nullptr) {
            break;
        }
        SegmentQueue::Tile& tile = *started_[chosen->issuing];
        if (!issue_one(now, tile, chosen->ready)) {
            break;
        }
        queue_.took(tile, chosen->ready);
        chosen->ready = -1;
        issued_stream_ = chosen;
    }
    return issued;
}

// Packs the oldest group of a pipelined bank. What finds no room keeps what was chosen after it
// where it is. Returns the number of segments issued.
int IssueBank::issue_chosen(Cycle now) {
    int issued = 0;
    while (const PickPipeline::Pick* const pick = pipeline_.front()) {
        SegmentQueue::Tile& tile = queue_.tile(pick->turn, pick->stream);
        const int domain = pick->domain;
        queue_.turn_to(tile, packing_.next_execution(now)); // set_ready_at() wants it
        if (!issue_one(now, tile, domain)) {
            break;
        }
        queue_.let_go(tile, domain);
        pipeline_.pop();
        ++issued;
    }
    return issued;
}

// The last action of a cycle in a pipelined bank: chooses the next group, for the first execution
// date of the next cycle as far as it is known. Nothing is chosen while the oldest group waits for
// room.
void IssueBank::choose(Cycle now) {
    if (pipeline_.front() != nullptr) {
        return;
    }
    pipeline_.shift();
    const Cycle slot = packing_.next_execution(now + 1);
    for (BankStream& stream : streams_) {
        stream.ready = -1;
    }
    for (int picks = 0; picks < config_.issue_width; ++picks) {
        BankStream* const chosen = choose_stream(slot);
        if (chosen == nullptr) {
            return;
        }
        SegmentQueue::Tile& tile = *started_[chosen->issuing];
        const std::size_t place = chosen->issuing - chosen->first_started;
        pipeline_.add({chosen->index, chosen->oldest + place, chosen->ready});
        queue_.hold_back(tile, chosen->ready);
        queue_.took(tile, chosen->ready);
        chosen->ready = -1;
        issued_stream_ = chosen;
    }
}

// The stream whose ready domain goes next, by the rule `scan`; nullptr: there is none.
inline __attribute__((always_inline)) BankStream* IssueBank::choose_stream(Cycle slot) {
    return config_.scan == DomainScan::RoundRobin ? first_ready(slot) : least_ready(slot);
}

// Looks for a domain of the stream that may issue, in its oldest tile that has one. False if there
// is none.
inline bool IssueBank::find_ready(BankStream& stream, Cycle slot) {
    for (std::size_t place = stream.first_started; stream.ready < 0 && place < stream.end_started;
         ++place) {
        SegmentQueue::Tile& tile = *started_[place];
        if (tile.waiting() != 0) {
            stream.ready = queue_.find(tile, slot);
            stream.issuing = place;
        }
    }
    return stream.ready >= 0;
}

// The next stream that has a ready domain, that which issued last at the end; nullptr: there is
// none.
inline BankStream* IssueBank::first_ready(Cycle slot) {
    BankStream* stream = issued_stream_;
    do {
        stream = stream->next;
        if (find_ready(*stream, slot)) {
            return stream;
        }
    } while (stream != issued_stream_);
    return nullptr;
}

// The stream whose ready domain has the smallest key; nullptr: there is none.
BankStream* IssueBank::least_ready(Cycle slot) {
    BankStream* chosen = nullptr;
    std::uint64_t least = ~std::uint64_t{0};
    for (BankStream& stream : streams_) {
        if (find_ready(stream, slot)) {
            const std::uint64_t key = SegmentQueue::key_of(*started_[stream.issuing], stream.ready);
            if (key < least) {
                least = key;
                chosen = &stream;
            }
        }
    }
    return chosen;
}

// True if a tile has ended.
bool IssueBank::finish_tiles() {
    if (closing_ == 0) {
        return false;
    }
    const std::size_t before = closing_;
    for (BankStream& stream : streams_) {
        finish_tiles(stream);
    }
    if (closing_ == before) {
        return false;
    }
    list_started();
    return true;
}

void IssueBank::finish_tiles(BankStream& stream) {
    while (stream.oldest < stream.entering && stream.oldest < stream.startable) {
        SegmentQueue::Tile& tile = tile_at(stream, stream.oldest);
        if (tile.waiting() != 0) {
            break;
        }
        log_tile(over_event_, tile.number(), {tile.context()});
        packing_.end_tile(self_, tile.number(), tile.context());
        tiles_.count(tile.number());
        queue_.clear(tile);
        ++stream.oldest;
        --closing_;
        contexts_owed_ = true;
    }
}

Slot IssueBank::idle_cause() const {
    if (queue_.empty()) {
        return Slot::Starved;
    }
    for (const SegmentQueue::Tile* const tile : started_) {
        if (tile->waiting() != 0) {
            return width_limited_ ? width_cause_ : no_room_ ? Slot::Blocked : Slot::Conflict;
        }
    }
    return Slot::Blocked;
}

// The next date at which waiting segments may go, if none went at `now`; kNever if none waits.
Cycle IssueBank::next_ready(Cycle now) const {
    if (no_room_) {
        return now + 1;
    }
    Cycle earliest = kNever;
    for (const SegmentQueue::Tile* const tile : started_) {
        if (tile->waiting() != 0) {
            earliest = std::min(earliest, queue_.next_ready(*tile));
        }
    }
    return earliest;
}

// Watches the inputs from which the next span may come. True if one of them has a span by now.
bool IssueBank::watch_inputs(Cycle now) {
    bool waiting = false;
    for (const BankStream& stream : streams_) {
        for (const BankStream::Input& input : stream.inputs) {
            if (input.ring->empty()) {
                watched_.push_back(input.ring);
            } else if (takes(stream, input)) {
                if (input.ring->head_date() > now) {
                    watched_.push_back(input.ring);
                } else {
                    waiting = true;
                }
            }
        }
    }
    return waiting;
}

// The next cycle in which anything can change, if there is nothing left to do at once: a domain
// becomes ready, an open packet has to leave, a Feature Buffer entry is freed, or a message
// arrives.
Cycle IssueBank::next_date(Cycle now) {
    const Cycle next = now + 1;
    Cycle limit = packing_.open_until();
    // A pipelined bank chooses for the date of the next cycle.
    const Cycle latency = packing_.next_execution(now) - now + (pipeline_.exists() ? 1 : 0);
    const Cycle ready = next_ready(now);
    if (ready != kNever) {
        limit = std::min(limit, std::max(next, ready > latency ? ready - latency : 0));
    }
    if (limit == next) {
        return next; // there is work then, whatever arrives
    }
    watched_.clear();
    if (!segmenter_.cutting() && watch_inputs(now)) {
        // More than a cycle's worth, or no Feature Buffer entry.
        const bool entries_only = features_full_ && stream_count_ == 1;
        limit = std::min(limit, entries_only ? std::max(next, features_.next_free()) : next);
        if (limit == next) {
            return next;
        }
    }
    if (!packing_.draws()) {
        watched_.push_back(terminations_);
    } else if (!terminations_->empty()) { // all that are due are there
        limit = std::min(limit, std::max(next, terminations_->head_date()));
    }
    if (contexts_owed_) {
        for (const BankStream& stream : streams_) {
            if (stream.startable < stream.oldest + contexts_) {
                watched_.push_back(stream.contexts_freed);
            }
        }
    }
    limit = self_.next_arrival(watched_.data(), watched_.size(), next, std::max(next, limit));
    if (limit >= kNever) {
        throw std::logic_error(std::string(name()) + ": nothing left to wait for, but after " +
                               std::to_string(tiles_.tiles()) + " tiles there is another one");
    }
    return limit;
}

} // namespace degs
