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

bool DrawnBank::can_run(const Parts& parts) {
    const IssueBank::Config& config = parts.config;
    const int domains =
        Segmenter::domains_per_tile(parts.job.tile_size, config.segment_length, config.banks);
    const Cycle cooled = ceil_div(config.segment_length, parts.packing.config().width) + 1 +
                         static_cast<Cycle>(config.reuse_cycles);
    return parts.packing.counts() && config.streams == 1 && parts.stream.inputs.size() == 1 &&
           config.scan == DomainScan::RoundRobin && config.scoreboard && config.fill.cycles == 0 &&
           places_of(parts.tiles_in_flight) * domains <= kPlaces && cooled < CoolingPlaces::kDates;
}

DrawnBank::DrawnBank(const Parts& parts, DrawnSpans& spans)
    : bank_(parts.bank), config_(parts.config), job_(parts.job), packing_(parts.packing),
      slice_(*parts.packing.slice()), stream_(parts.stream), input_(stream_.inputs[0]),
      spans_(spans), terminations_(parts.terminations), segmenter_(parts.segmenter),
      features_(parts.features), tile_end_(parts.tiles), self_(parts.self), stats_(parts.stats),
      domains_(Segmenter::domains_per_tile(job_.tile_size, config_.segment_length, config_.banks)),
      segment_length_(config_.segment_length), segments_per_cycle_(config_.segments_per_cycle),
      spans_per_cycle_(parts.spans_per_cycle), issue_width_(config_.issue_width),
      reuse_(config_.reuse_cycles), contexts_(parts.contexts),
      tiles_in_flight_(parts.tiles_in_flight),
      by_task_(config_.termination == TerminationGrain::Task),
      sees_pixels_(config_.termination != TerminationGrain::Segment),
      width_cause_(parts.width_cause), pool_(config_.queue_depth),
      packet_(packing_.config().width, packing_.config().latency_cycles, packing_.config().depth) {
    for (Waiting& place : pool_) {
        place.next = free_;
        free_ = &place;
    }
    tiles_.resize(places_of(tiles_in_flight_));
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
    tile.context = context_in_turn(stream_.entering, contexts_, config_.first_context);
    tile.later = 0;
    cooling_.forget(tile.places);
    const int width = job_.tiles[number].width;
    Place* place = &places_[tile.first];
    for (const Segmenter::Domain& domain : segmenter_.domains()) {
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
    place.live = sees_pixels_ || place.ended == kAllPixels ? ~place.ended : kAllPixels;
}

void DrawnBank::end_pixels() {
    while (!terminations_.empty() && terminations_.head_date() <= now_) {
        const Termination message = terminations_.take(self_);
        const std::size_t turn =
            stream_.turn_of(message.context - config_.first_context, contexts_);
        Tile& tile = tile_at(turn);
        if (turn >= stream_.first_unstarted() || tile.number != message.tile) {
            continue; // the tile is over for this bank
        }
        const int number = tile.first + segmenter_.domain_of(message.row, message.column);
        Place& place = places_[number];
        end_pixels(place, message.mask);
        while (place.ended == kAllPixels && place.head != nullptr) {
            features_.release(place.head->feature, now_);
            stats_.drop(place.head->mask);
            pop(number);
        }
    }
}

void DrawnBank::see_contexts() {
    const std::size_t before = stream_.startable;
    while (owed_contexts() && self_.arrived(*stream_.contexts_freed)) {
        stream_.contexts_freed->drop(self_);
        ++stream_.startable;
    }
    contexts_owed_ = owed_contexts();
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
    stream_.enterable = enterable();
}

// The tasks of a segment with ended pixels that are issued.
std::uint32_t DrawnBank::tasks_of(const Waiting& segment, std::uint32_t live) {
    const std::uint32_t wanted = segment.mask & live;
    return by_task_ && wanted != 0 ? segment.mask : wanted; // one live task takes the others along
}

// Pixels of a place end with these tasks of a packet.
void DrawnBank::end_drawn(int number, std::uint32_t tasks, Cycle date) {
    const Tile& tile = tile_of(number);
    const int domain = number - tile.first;
    const Segmenter::Domain& place = segmenter_.domains()[domain];
    TaskRun run;
    run.tile = tile.number;
    run.domain = domain;
    run.task.row = inside_tile(place.row);
    run.task.column = inside_tile(place.column);
    run.task.context = tile.context;
    slice_.end_drawn(run, tasks, date);
}

void DrawnBank::send_part(Slot cause) {
    packing_.count_idle(cause, packet_.room());
    send();
}

// See PackingUnit::end_tile().
void DrawnBank::end_tile(const Tile& tile) {
    if (packet_.open() && ends_tile_) {
        send_part(Slot::Starved);
    }
    packing_.name_end(tile.number, tile.context);
    if (packet_.open()) {
        ends_tile_ = true;
    } else {
        packing_.pass_end(now_);
    }
}

void DrawnBank::finish_tiles() {
    const std::size_t before = stream_.oldest;
    while (stream_.oldest < stream_.entering && stream_.oldest < stream_.startable) {
        const Tile& tile = tile_at(stream_.oldest);
        if ((occupied_ & tile.places) != 0 || (left_ > 0 && &tile_of(cut_) == &tile)) {
            break;
        }
        end_tile(tile);
        ++stream_.oldest;
        tile_end_.count(tile.number);
        --closing_;
        contexts_owed_ = true;
    }
    if (stream_.oldest != before) {
        list_started();
    }
}

// See IssueBank::take_end().
void DrawnBank::take_end(TileNumber number) {
    if (number == kNoTile) {
        tile_end_.count(number);
        return;
    }
    features_.close(now_);
    ++stream_.entering;
    ++closing_;
    stream_.enterable = enterable();
    stream_.entered = false;
}

Slot DrawnBank::idle_cause() const {
    if (size_ == 0) {
        return Slot::Starved;
    }
    return issuable() == 0  ? Slot::Blocked
           : width_limited_ ? width_cause_
           : no_room_       ? Slot::Blocked
                            : Slot::Conflict;
}

// See IssueBank::next_date(). All ends of pixels that are due are in their ring.
Cycle DrawnBank::next_date() {
    const Cycle next = now_ + 1;
    Cycle limit = packet_.open_until();
    const Cycle latency = packet_.next_execution(now_) - now_;
    const Cycle ready = no_room_ ? next : cooling_.next_end(issuable());
    if (ready != kNever) {
        limit = std::min(limit, std::max(next, ready > latency ? ready - latency : 0));
    }
    if (limit == next) {
        return next;
    }
    std::array<FifoBase*, 2> watched{};
    std::size_t count = 0;
    const bool hungry = free_ != nullptr && left_ <= 0;
    if (hungry && (spans_.empty() || (takes() && spans_.head_date() > now_))) {
        watched[count++] = &spans_;
    } else if (hungry && takes()) {
        limit = std::min(limit, features_full_ ? std::max(next, features_.next_free()) : next);
        if (limit == next) {
            return next;
        }
    }
    if (!terminations_.empty()) {
        limit = std::min(limit, std::max(next, terminations_.head_date()));
    }
    if (contexts_owed_ && owed_contexts()) {
        watched[count++] = stream_.contexts_freed;
    }
    limit = self_.next_arrival(watched.data(), count, next, std::max(next, limit));
    if (limit >= kNever) {
        throw std::logic_error(std::string(bank_.name()) +
                               ": nothing left to wait for, but after " +
                               std::to_string(tile_end_.tiles()) + " tiles there is another one");
    }
    return limit;
}

} // namespace degs
