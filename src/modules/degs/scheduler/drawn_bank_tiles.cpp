// SPDX-License-Identifier: Apache-2.0
// Tiles and packets of a bank of drawn tasks, and the date at which it has something to do again.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "modules/degs/scheduler/drawn_bank.hpp"
#include "tlm/ceil_div.hpp"

namespace degs {
namespace {

// Tiles in flight find theirs by their turn modulo a power of two.
int places_of(int tiles) {
    int places = 1;
    while (places < tiles) {
        places *= 2;
    }
    return places;
}

} // namespace

bool DrawnBank::can_run(const IssueBank& bank) {
    const PackingUnit& packing = bank.packing_;
    const int domains = Segmenter::domains_per_tile(
        bank.job_.tile_size, bank.config_.segment_length, bank.config_.banks);
    const Cycle cooled = ceil_div(bank.config_.segment_length, packing.config_.width) + 1 +
                         static_cast<Cycle>(bank.config_.reuse_cycles);
    return packing.draws() && !packing.packets_ && packing.part_ == nullptr &&
           bank.stream_count_ == 1 && bank.streams_[0].inputs.size() == 1 &&
           bank.config_.scan == DomainScan::RoundRobin && bank.config_.scoreboard && !bank.fills_ &&
           packing.config_.reorganisation && !packing.ports_ &&
           places_of(bank.tiles_in_flight_) * domains <= kPlaces && cooled < CoolingPlaces::kDates;
}

DrawnBank::DrawnBank(IssueBank& bank)
    : bank_(bank), packing_(bank.packing_), slice_(*bank.packing_.slice_),
      stream_(bank.streams_[0]), input_(stream_.inputs[0]), spans_(*bank.drawn_spans_),
      features_(bank.features_), self_(bank.self_),
      domains_(Segmenter::domains_per_tile(bank.job_.tile_size, bank.config_.segment_length,
                                           bank.config_.banks)),
      segment_length_(bank.config_.segment_length),
      segments_per_cycle_(bank.config_.segments_per_cycle), spans_per_cycle_(bank.spans_per_cycle_),
      issue_width_(bank.config_.issue_width), reuse_(bank.config_.reuse_cycles),
      latency_(packing_.latency_), width_(packing_.config_.width), capacity_(packing_.capacity_),
      pool_(bank.config_.queue_depth) {
    for (Waiting& place : pool_) {
        place.next = free_;
        free_ = &place;
    }
    tiles_.resize(places_of(bank.tiles_in_flight_));
    tile_mask_ = tiles_.size() - 1;
    for (Tile& tile : tiles_) {
        tile.first = static_cast<int>(&tile - tiles_.data()) * domains_;
        for (int domain = 0; domain < domains_; ++domain) {
            tile.places |= std::uint64_t{1} << (tile.first + domain);
        }
    }
    for (Place& place : places_) {
        place.end = &place.head;
    }
}

void DrawnBank::enter_tile(TileNumber number) {
    Tile& tile = tile_at(stream_.entering);
    tile.number = number;
    tile.context = context_in_turn(stream_.entering, bank_.contexts_, bank_.config_.first_context);
    tile.later = 0;
    cooling_.forget(tile.places);
    const int width = bank_.job_.tiles[number].width;
    Place* place = &places_[tile.first];
    for (const Segmenter::Domain& domain : bank_.segmenter_.domains()) {
        place->executed = static_cast<std::int32_t>(now_ - slice_.writeback());
        place->ended = 0;
        place->live = kAllPixels;
        end_pixels(*place++,
                   ~bits_between(0, std::clamp(width - domain.column, 0, segment_length_)));
    }
    stream_.entered = true;
    list_started();
}

void DrawnBank::end_pixels(Place& place, std::uint32_t mask) const {
    place.ended |= mask;
    place.live = bank_.sees_pixels_ || place.ended == kAllPixels ? ~place.ended : kAllPixels;
}

void DrawnBank::end_pixels() {
    DatedFifo<Termination>& terminations = *bank_.terminations_;
    while (!terminations.empty() && terminations.head_date() <= now_) {
        const Termination message = terminations.take(self_);
        const std::size_t turn = bank_.turn_of(stream_, message.context);
        Tile& tile = tile_at(turn);
        if (turn >= stream_.first_unstarted() || tile.number != message.tile) {
            continue; // the tile is over for this bank
        }
        const int number = tile.first + bank_.segmenter_.domain_of(message.row, message.column);
        Place& place = places_[number];
        end_pixels(place, message.mask);
        while (place.ended == kAllPixels && place.head != nullptr) {
            features_.release(place.head->feature, now_);
            bank_.drop(place.head->mask);
            pop(number);
        }
    }
}

void DrawnBank::see_contexts() {
    const std::size_t before = stream_.startable;
    while (stream_.startable < stream_.oldest + bank_.contexts_ &&
           self_.arrived(*stream_.contexts_freed)) {
        stream_.contexts_freed->drop(self_);
        ++stream_.startable;
    }
    bank_.contexts_owed_ = stream_.startable < stream_.oldest + bank_.contexts_;
    if (stream_.startable != before) {
        list_started();
    }
}

void DrawnBank::list_started() {
    started_.clear();
    startable_ = 0;
    for (std::size_t turn = stream_.oldest; turn < stream_.first_unstarted(); ++turn) {
        started_.push_back(&tile_at(turn));
        startable_ |= tile_at(turn).places;
    }
    stream_.enterable = stream_.entering < bank_.end_of_intake(stream_);
}

// Those of a segment with ended pixels that are issued.
std::uint32_t DrawnBank::tasks_of(const Waiting& segment, std::uint32_t live) {
    const std::uint32_t wanted = segment.mask & live;
    return bank_.by_task_ && wanted != 0 ? segment.mask
                                         : wanted; // one live task takes the others along
}

// The same where pixels end with some of the tasks, so that their packets matter.
Cycle DrawnBank::end_drawn(int number, const Waiting& segment, std::uint32_t tasks) {
    const Tile& tile = tile_of(number);
    const int domain = number - tile.first;
    const Segmenter::Domain& place = bank_.segmenter_.domains()[domain];
    TaskRun run;
    run.tile = tile.number;
    run.domain = domain;
    run.task.row = inside_tile(place.row);
    run.task.column = inside_tile(place.column);
    run.task.context = tile.context;
    Cycle last = next_slot_;
    for (std::uint32_t left = tasks; left != 0;) {
        const int count = __builtin_popcount(left);
        const int taken = std::min(count, width_ - tasks_);
        const std::uint32_t part = taken == count ? left : lowest_bits(left, taken);
        last = next_slot_;
        if ((part & segment.ended) != 0) {
            slice_.end_drawn(run, part & segment.ended, last);
        }
        left ^= part;
        tasks_ += taken;
        if (tasks_ == width_) {
            tasks_ = 0;
            send(width_);
        }
    }
    return last;
}

void DrawnBank::send_part(Slot cause) {
    const int tasks = tasks_;
    packing_.idle_[cause] += width_ - tasks;
    tasks_ = 0;
    send(tasks);
}

void DrawnBank::settle_idle() {
    idle_pending_ = false;
    packing_.idle_ += packing_.since_last_;
    packing_.since_last_ = SlotAccount{};
}

// True if a tile has ended.
bool DrawnBank::finish_tiles() {
    const std::size_t before = stream_.oldest;
    while (stream_.oldest < stream_.entering && stream_.oldest < stream_.startable) {
        const Tile& tile = tile_at(stream_.oldest);
        if ((occupied_ & tile.places) != 0 || (left_ > 0 && &tile_of(cut_) == &tile)) {
            break;
        }
        if (open() && ends_tile_) {
            send_part(Slot::Starved);
        }
        packing_.ended_tile_ = tile.number;
        packing_.ended_context_ = tile.context;
        if (open()) {
            ends_tile_ = true;
        } else {
            packing_.tell_end(packing_.passed_.pass_end(now_, now_ + latency_), false);
        }
        ++stream_.oldest;
        bank_.tiles_.count(tile.number);
        --bank_.closing_;
        bank_.contexts_owed_ = true;
    }
    if (stream_.oldest == before) {
        return false;
    }
    list_started();
    return true;
}

Slot DrawnBank::idle_cause() const {
    if (size_ == 0) {
        return Slot::Starved;
    }
    return issuable() == 0  ? Slot::Blocked
           : width_limited_ ? bank_.width_cause_
           : no_room_       ? Slot::Blocked
                            : Slot::Conflict;
}

// See IssueBank::next_date(). All ends of pixels that are due are in their ring.
Cycle DrawnBank::next_date() {
    const Cycle next = now_ + 1;
    Cycle limit = open() ? next_slot_ - latency_ : kNever;
    const Cycle latency = next_execution() - now_;
    const Cycle ready = no_room_ ? next : cooling_.next_end(issuable());
    if (ready != kNever) {
        limit = std::min(limit, std::max(next, ready > latency ? ready - latency : 0));
    }
    if (limit == next) {
        return next;
    }
    std::vector<FifoBase*>& watched = bank_.watched_;
    watched.clear();
    const bool hungry = free_ != nullptr && left_ <= 0;
    if (hungry && (spans_.empty() || (takes() && spans_.head_date() > now_))) {
        watched.push_back(&spans_);
    } else if (hungry && takes()) {
        limit = std::min(limit, features_full_ ? std::max(next, features_.next_free()) : next);
        if (limit == next) {
            return next;
        }
    }
    const DatedFifo<Termination>& terminations = *bank_.terminations_;
    if (!terminations.empty()) {
        limit = std::min(limit, std::max(next, terminations.head_date()));
    }
    if (bank_.contexts_owed_ && stream_.startable < stream_.oldest + bank_.contexts_) {
        watched.push_back(stream_.contexts_freed);
    }
    limit = self_.next_arrival(watched.data(), watched.size(), next, std::max(next, limit));
    if (limit >= kNever) {
        throw std::logic_error(
            std::string(bank_.name()) + ": nothing left to wait for, but after " +
            std::to_string(bank_.tiles_.tiles()) + " tiles there is another one");
    }
    return limit;
}

} // namespace degs
