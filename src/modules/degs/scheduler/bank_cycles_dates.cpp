// SPDX-License-Identifier: Apache-2.0
// Why a bank issues nothing, and the date at which it has something to do again.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "modules/degs/scheduler/bank_cycles.hpp"

namespace degs {

Slot BankCycles::idle_cause() const {
    if (size_ == 0) {
        return Slot::Starved;
    }
    return issuable_ == 0   ? Slot::Blocked
           : width_limited_ ? width_cause_
           : no_room_       ? Slot::Blocked
                            : Slot::Conflict;
}

// The cycles after the next execution date until waiting segments may go, if none went at `now`;
// kNever if none waits.
Cycle BankCycles::next_ready() const {
    const Cycle slot = packet_.next_execution(now_);
    if (choice_ == Choice::Oldest) {
        return all_lanes_.until_next(slot);
    }
    Cycle earliest = kNever;
    for (const Tile* const tile : started_) {
        if (tile->waiting != 0) {
            earliest =
                std::min(earliest, choice_ == Choice::InTurn ? tile->lanes.until_next_in_turn(slot)
                                                             : tile->lanes.until_next(slot));
        }
    }
    return earliest;
}

// Watches the inputs from which the next span may come. True if one of them has a span by now.
bool BankCycles::watch_inputs() {
    bool waiting = false;
    for (const BankStream& stream : streams_) {
        for (const BankStream::Input& input : stream.inputs) {
            FifoBase& ring =
                input.spans != nullptr ? static_cast<FifoBase&>(*input.spans) : *input.ring;
            if (ring.empty()) {
                watched_.push_back(&ring);
            } else if (takes(stream, input)) {
                if (ring.head_date() > now_) {
                    watched_.push_back(&ring);
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
Cycle BankCycles::next_date() {
    const Cycle next = now_ + 1;
    if (no_room_) {
        return next;
    }
    Cycle limit = packet_.open_until();
    if (Cycle ready = next_ready(); ready != kNever) {
        ready -= pipeline_.exists() ? 1 : 0; // it chooses for the date of the next cycle
        limit = std::min(limit, now_ + ready);
    }
    if (limit <= next) {
        return next;
    }
    watched_.clear();
    if (left_ <= 0 && watch_inputs()) {
        // More than a cycle's worth, or no Feature Buffer entry.
        const bool entries_only = features_full_ && single_stream_;
        limit = std::min(limit, entries_only ? std::max(next, features_.next_free()) : next);
        if (limit == next) {
            return next;
        }
    }
    if (slice_ == nullptr) {
        watched_.push_back(&terminations_);
    } else if (!terminations_.empty()) { // all that are due are there
        limit = std::min(limit, std::max(next, terminations_.head_date()));
    }
    if (contexts_owed_) {
        for (const BankStream& stream : streams_) {
            if (owes_contexts(stream)) {
                watched_.push_back(stream.contexts_freed);
            }
        }
    }
    limit = self_.next_arrival(watched_.data(), watched_.size(), next, std::max(next, limit));
    if (limit >= kNever) {
        throw std::logic_error(std::string(bank_.name()) +
                               ": nothing left to wait for, but after " +
                               std::to_string(tile_end_.tiles()) + " tiles there is another one");
    }
    return limit;
}

} // namespace degs
