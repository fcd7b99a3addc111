// SPDX-License-Identifier: Apache-2.0
// Tiles and packets of a bank of drawn tasks, and the date at which it has something to do again.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "modules/degs/scheduler/drawn_bank.hpp"

namespace degs {
namespace {

// More domains than these would take much of the host's memory in each bank.
constexpr std::size_t kMostDomains = 4096;
// Keys of waiting segments have a number each, above that of their domain.
constexpr int kMostSegments = 65535;

// Tiles in flight find theirs by their turn modulo a power of two.
std::size_t places_of(const DrawnBank::Parts& parts) {
    const int tiles = parts.streams.size() == 1 ? parts.tiles_in_flight : parts.contexts;
    std::size_t places = 1;
    while (places < static_cast<std::size_t>(tiles)) {
        places *= 2;
    }
    return places;
}

int domains_of(const DrawnBank::Parts& parts) {
    return Segmenter::domains_per_tile(parts.job.tile_size, parts.config.segment_length,
                                       parts.config.banks);
}

} // namespace

// One of several streams takes in no tile without a context, so that all that waits may be issued
// if each has one.
DrawnBank::Choice DrawnBank::choice_of(const Parts& parts) {
    if (parts.config.scan == DomainScan::RoundRobin &&
        domains_of(parts) <= DomainLanes::kMostInTurn) {
        return Choice::InTurn;
    }
    return parts.config.scan == DomainScan::Oldest && parts.streams.size() != 1 &&
                   parts.contexts == 1
               ? Choice::Oldest
               : Choice::Keyed;
}

bool DrawnBank::can_run(const Parts& parts) {
    return parts.packing.counts() && parts.config.scoreboard && parts.config.select_cycles == 0 &&
           parts.config.queue_depth <= kMostSegments &&
           parts.streams.size() * places_of(parts) * domains_of(parts) <= kMostDomains;
}

DrawnBank::DrawnBank(const Parts& parts)
    : bank_(parts.bank), config_(parts.config), job_(parts.job), packing_(parts.packing),
      slice_(*parts.packing.slice()), streams_(parts.streams),
      spans_(streams_.size() == 1 ? streams_.front().inputs.front().spans : nullptr),
      terminations_(parts.terminations), segmenter_(parts.segmenter), features_(parts.features),
      tile_end_(parts.tiles), self_(parts.self), stats_(parts.stats),
      single_stream_(streams_.size() == 1), domain_count_(domains_of(parts)),
      segment_length_(config_.segment_length), segments_per_cycle_(config_.segments_per_cycle),
      spans_per_cycle_(parts.spans_per_cycle), issue_width_(config_.issue_width),
      reuse_(config_.reuse_cycles), contexts_(parts.contexts),
      tiles_in_flight_(parts.tiles_in_flight), scan_(config_.scan), choice_(choice_of(parts)),
      by_task_(config_.termination == TerminationGrain::Task),
      sees_pixels_(config_.termination != TerminationGrain::Segment),
      fills_(config_.fill.cycles != 0), width_cause_(parts.width_cause), pool_(config_.queue_depth),
      tile_mask_(places_of(parts) - 1), own_(streams_.size()), next_stream_(&streams_.front()),
      packet_(packing_.config().width, packing_.config().latency_cycles, packing_.config().depth,
              packing_.config().packets_per_cycle),
      trace_(parts.trace) {
    for (Waiting& place : pool_) {
        place.next = free_;
        free_ = &place;
    }
    const auto tiles = static_cast<int>(streams_.size() * places_of(parts));
    const int domains = tiles * domain_count_;
    domains_.resize(domains);
    for (Domain& domain : domains_) {
        domain.end = &domain.head;
    }
    tiles_.reserve(tiles);
    if (choice_ == Choice::Oldest) {
        all_lanes_ = DomainLanes(domains);
    }
    for (int first = 0; first < domains; first += domain_count_) {
        const bool shared = choice_ == Choice::Oldest;
        tiles_.emplace_back(shared ? all_lanes_.part(first, domain_count_)
                                   : DomainLanes(domain_count_),
                            &domains_[first]);
        if (shared) {
            tiles_.back().first_lane = first;
            lane_tiles_.insert(lane_tiles_.end(), domain_count_, &tiles_.back());
        }
    }
    key_step_ = (choice_ == Choice::Oldest ? all_lanes_ : tiles_.front().lanes).mask() + 1;
    watched_.reserve(streams_.size() * (streams_.front().inputs.size() + 1));
}

void DrawnBank::enter_tile(BankStream& stream, TileNumber number) {
    Tile& tile = tile_at(stream, stream.entering);
    own_[stream.index].entering = &tile;
    const int first_context = config_.first_context + static_cast<int>(stream.index) * contexts_;
    tile.number = number;
    tile.context = context_in_turn(stream.entering, contexts_, first_context);
    tile.cursor = 0;
    tile.lanes.set_dates(now_);
    const PixelRange drawn = job_.tiles[number].drawn_columns();
    Domain* domain = tile.domains;
    for (const Segmenter::Domain& place : segmenter_.domains()) {
        domain->ended = 0;
        domain->live = kAllPixels;
        end_pixels(*domain++, ~bits_of(drawn.relative_to(place.column), segment_length_));
    }
    stream.entered = true;
    list_started();
}

// The keys have come to their end: the segments that wait get the lowest ones, in their order.
void DrawnBank::renumber() {
    std::vector<Waiting*> waiting;
    for (const Domain& domain : domains_) {
        for (Waiting* segment = domain.head; segment != nullptr; segment = segment->next) {
            waiting.push_back(segment);
        }
    }
    std::sort(waiting.begin(), waiting.end(),
              [](const Waiting* a, const Waiting* b) { return a->key < b->key; });
    next_key_ = 0;
    for (Waiting* const segment : waiting) {
        segment->key = next_key_ | (segment->key & (key_step_ - 1));
        next_key_ += key_step_;
    }
    for (Tile& tile : tiles_) {
        for (int i = 0; i < domain_count_; ++i) {
            if (tile.domains[i].head != nullptr) {
                tile.lanes.set_key(i, tile.domains[i].head->key);
            }
        }
    }
}

void DrawnBank::end_pixels(Domain& domain, std::uint32_t mask) const {
    domain.ended |= mask;
    domain.live = sees_pixels_ || domain.ended == kAllPixels ? ~domain.ended : kAllPixels;
}

void DrawnBank::end_pixels() {
    while (!terminations_.empty() && terminations_.head_date() <= now_) {
        end_pixels(terminations_.take(self_));
    }
}

void DrawnBank::end_pixels(const Termination& message) {
    const int context = message.context - config_.first_context;
    const BankStream& stream = streams_[context / contexts_];
    const std::size_t turn = stream.turn_of(context % contexts_, contexts_);
    Tile& tile = tile_at(stream, turn);
    if (turn >= stream.first_unstarted() || tile.number != message.tile) {
        return; // the tile is over for this bank
    }
    const int number = segmenter_.domain_of(message.row, message.column);
    Domain& domain = tile.domains[number];
    end_pixels(domain, message.mask);
    while (domain.ended == kAllPixels && domain.head != nullptr) {
        features_.release(domain.head->feature, now_);
        drop(*domain.head, domain.head->mask);
        stats_.segments_dropped++;
        if (choice_ == Choice::InTurn) {
            pop<Choice::InTurn>(tile, number);
        } else {
            pop<Choice::Keyed>(tile, number);
        }
    }
}

// Tasks of a segment go nowhere.
void DrawnBank::drop(const Waiting& segment, std::uint32_t tasks) {
    stats_.tasks_dropped += __builtin_popcount(tasks);
    inside_ -= __builtin_popcount(tasks & segment.inside);
}

// A context comes back only after this bank, too, has ended the tile that holds it.
void DrawnBank::see_contexts() {
    contexts_owed_ = false;
    contexts_from_ = kNever;
    bool gained = false;
    for (BankStream& stream : streams_) {
        while (owes_contexts(stream) && self_.arrived(*stream.contexts_freed)) {
            stream.contexts_freed->drop(self_);
            ++stream.startable;
            gained = true;
        }
        if (owes_contexts(stream)) {
            contexts_owed_ = true;
            contexts_from_ = std::min(contexts_from_, stream.contexts_freed->quiet_until());
        }
    }
    if (gained) {
        list_started();
    }
}

// Called when a tile has begun, got a context, or ended.
void DrawnBank::list_started() {
    for (Tile* const tile : started_) {
        tile->started = false;
    }
    started_.clear();
    issuable_ = 0;
    spans_from_ = 0;
    for (BankStream& stream : streams_) {
        stream.first_started = started_.size();
        for (std::size_t turn = stream.oldest; turn < stream.first_unstarted(); ++turn) {
            Tile& tile = tile_at(stream, turn);
            tile.started = true;
            issuable_ += tile.waiting;
            started_.push_back(&tile);
        }
        stream.end_started = started_.size();
        own_[stream.index].only =
            stream.end_started == stream.first_started + 1 ? started_.back() : nullptr;
        stream.enterable = stream.entering < end_of_intake(stream);
    }
}

// The tasks of a segment with ended pixels that are issued.
std::uint32_t DrawnBank::tasks_of(const Waiting& segment, std::uint32_t live) {
    const std::uint32_t wanted = segment.mask & live;
    return by_task_ && wanted != 0 ? segment.mask : wanted; // one live task takes the others along
}

// Pixels of a domain end with these tasks of a packet.
void DrawnBank::end_drawn(const Tile& tile, int number, std::uint32_t tasks, Cycle date) {
    const Segmenter::Domain& place = segmenter_.domains()[number];
    TaskRun run;
    run.tile = tile.number;
    run.domain = number;
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
    const std::size_t before = closing_;
    for (BankStream& stream : streams_) {
        finish_tiles(stream);
    }
    if (closing_ != before) {
        list_started();
    }
}

void DrawnBank::finish_tiles(BankStream& stream) {
    while (stream.oldest < stream.entering && stream.oldest < stream.startable) {
        const Tile& tile = tile_at(stream, stream.oldest);
        if (tile.waiting != 0) {
            break;
        }
        end_tile(tile);
        tile_end_.count(tile.number);
        ++stream.oldest;
        --closing_;
        contexts_owed_ = true;
        contexts_from_ = 0;
    }
}

// See IssueBank::take_end().
void DrawnBank::take_end(BankStream& stream, TileNumber number) {
    if (++stream.ends_seen != stream.inputs.size()) {
        return;
    }
    if (number == kNoTile) {
        tile_end_.count(number);
        return;
    }
    features_.close(now_, stream.index);
    stream.ends_seen = 0;
    ++stream.entering;
    ++closing_;
    stream.enterable = stream.entering < end_of_intake(stream);
    stream.entered = false;
    spans_from_ = 0;
}

// All tasks that came in have been issued or dropped. A useful task is never dropped.
void DrawnBank::finish() {
    now_ = self_.local();
    if (packet_.open()) {
        send_part(Slot::Starved);
    }
    if (config_.granted) {
        packing_.end_tile(self_, kNoTile, 0);
    }
    stats_.segments_issued = segments_in_ - stats_.segments_dropped;
    stats_.tasks_issued = stats_.tasks_in - stats_.tasks_dropped;
    SlotAccount executed;
    executed[Slot::Useful] = useful_;
    executed[Slot::Boundary] = stats_.tasks_issued - inside_;
    executed[Slot::Terminated] = inside_ - useful_;
    slice_.count_drawn(executed);
    self_.finish();
}

Slot DrawnBank::idle_cause() const {
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
Cycle DrawnBank::next_ready() const {
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

// See IssueBank::watch_inputs().
bool DrawnBank::watch_inputs() {
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

// See IssueBank::next_date(). All ends of pixels that are due are in their ring.
Cycle DrawnBank::next_date() {
    const Cycle next = now_ + 1;
    if (no_room_) {
        return next;
    }
    Cycle limit = packet_.open_until();
    if (const Cycle ready = next_ready(); ready != kNever) {
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
    if (!terminations_.empty()) {
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
