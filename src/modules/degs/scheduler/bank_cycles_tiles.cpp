// SPDX-License-Identifier: Apache-2.0
// The tiles of a bank: how they enter, what ends in them, and how they end.
#include <algorithm>

#include "modules/degs/scheduler/bank_cycles.hpp"

namespace degs {
namespace {

// One scan over the domains of all tiles pays off up to so many of them.
constexpr std::size_t kMostDomainsOfAll = 4096;

// The number of places for tiles in flight of a stream. It is a power of two, because a tile finds
// its place by its turn modulo that number.
std::size_t places_of(const BankCycles::Parts& parts) {
    const int tiles = parts.streams.size() == 1 ? parts.tiles_in_flight : parts.contexts;
    std::size_t places = 1;
    while (places < static_cast<std::size_t>(tiles)) {
        places *= 2;
    }
    return places;
}

int domains_of(const BankCycles::Parts& parts) {
    return Segmenter::domains_per_tile(parts.job.tile_size, parts.config.segment_length,
                                       parts.config.banks);
}

// True if a key has room for the number of a domain below an order of arrival in which all
// segments that wait are distinct.
bool keys_hold(std::uint32_t mask, int segments) {
    return (std::uint64_t{mask} + 1) * (static_cast<std::uint64_t>(segments) + 1) <
           DomainLanes::kTop;
}

} // namespace

// One of several streams takes in no tile without a context, so that all that waits may be issued
// if each has one.
BankCycles::Choice BankCycles::choice_of(const Parts& parts) {
    if (parts.config.scan == DomainScan::RoundRobin &&
        domains_of(parts) <= DomainLanes::kMostInTurn) {
        return Choice::InTurn;
    }
    const std::size_t domains = parts.streams.size() * domains_of(parts);
    return parts.config.scan == DomainScan::Oldest && parts.streams.size() != 1 &&
                   parts.contexts == 1 && parts.config.select_cycles == 0 &&
                   parts.packing.counts() && domains <= kMostDomainsOfAll &&
                   keys_hold(kMostDomainsOfAll, parts.config.queue_depth)
               ? Choice::Oldest
               : Choice::Keyed;
}

BankCycles::BankCycles(const Parts& parts)
    : bank_(parts.bank), config_(parts.config), job_(parts.job), packing_(parts.packing),
      slice_(parts.packing.slice()), streams_(parts.streams),
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
      fills_(config_.fill.cycles != 0), counts_(packing_.counts()), scoreboard_(config_.scoreboard),
      width_cause_(parts.width_cause), pool_(config_.queue_depth),
      values_(counts_ ? 0 : config_.queue_depth), tile_mask_(places_of(parts) - 1),
      own_(streams_.size()), pipeline_(config_.select_cycles, config_.issue_width),
      next_stream_(&streams_.front()), packet_(packing_.packet()), trace_(parts.trace),
      log_(parts.log) {
    for (Waiting& place : pool_) {
        place.next = free_;
        free_ = &place;
    }
    tiles_.resize(streams_.size() * places_of(parts));
    if (choice_ == Choice::Oldest) {
        all_lanes_ = DomainLanes(static_cast<int>(tiles_.size()) * domain_count_);
        for (std::unique_ptr<Tile>& place : tiles_) {
            make_tile(place);
        }
    }
    const std::uint32_t mask =
        choice_ == Choice::Oldest ? all_lanes_.mask() : DomainLanes(domain_count_).mask();
    if (keys_hold(mask, config_.queue_depth)) {
        key_mask_ = mask;
        key_step_ = mask + 1;
    }
    watched_.reserve(streams_.size() * (streams_.front().inputs.size() + 1) + 1);
}

// A place for tiles in flight takes host memory once a tile comes to it.
void BankCycles::make_tile(std::unique_ptr<Tile>& place) {
    place = std::make_unique<Tile>(domain_count_);
    Tile& tile = *place;
    for (Domain& domain : tile.own) {
        domain.end = &domain.head;
    }
    if (choice_ != Choice::Oldest) {
        tile.lanes = DomainLanes(domain_count_);
        return;
    }
    tile.first_lane = static_cast<int>(lane_tiles_.size());
    tile.lanes = all_lanes_.part(tile.first_lane, domain_count_);
    lane_tiles_.insert(lane_tiles_.end(), domain_count_, &tile);
}

// Called when the first item of a tile is taken. Pixels outside of the image count as ended.
void BankCycles::enter_tile(BankStream& stream, TileNumber number) {
    std::unique_ptr<Tile>& home = place_of(stream.index, stream.entering);
    if (home == nullptr) {
        make_tile(home);
    }
    Tile& tile = *home;
    own_[stream.index].entering = &tile;
    const int first_context = config_.first_context + static_cast<int>(stream.index) * contexts_;
    tile.number = number;
    tile.context = context_in_turn(stream.entering, contexts_, first_context);
    tile.cursor = 0;
    tile.lanes.set_dates(now_);
    const PixelRange columns = job_.tiles[number].image_columns();
    Domain* domain = tile.domains;
    for (const Segmenter::Domain& place : segmenter_.domains()) {
        domain->ended = 0;
        domain->live = kAllPixels;
        end_pixels(*domain++, ~bits_of(columns.relative_to(place.column), segment_length_));
    }
    stream.entered = true;
    list_started();
    if (log_ != nullptr) {
        log_->enter(now_, number, tile.context, columns);
    }
}

// Called when the largest key has been given: the waiting segments get the lowest keys, in their
// order, so that counting can go on.
void BankCycles::renumber() {
    std::vector<Waiting*> waiting;
    for (const std::unique_ptr<Tile>& tile : tiles_) {
        for (std::size_t i = 0; tile != nullptr && i < tile->own.size(); ++i) {
            for (Waiting* each = tile->own[i].head; each != nullptr; each = each->next) {
                waiting.push_back(each);
            }
        }
    }
    std::sort(waiting.begin(), waiting.end(),
              [](const Waiting* a, const Waiting* b) { return a->key < b->key; });
    next_key_ = 0;
    for (Waiting* const segment : waiting) {
        segment->key = next_key_ | (segment->key & (key_step_ - 1));
        next_key_ += key_step_;
    }
    for (const std::unique_ptr<Tile>& tile : tiles_) {
        for (std::size_t i = 0; tile != nullptr && i < tile->own.size(); ++i) {
            const Domain& domain = tile->own[i];
            if (domain.head != nullptr && domain.held == 0) {
                tile->lanes.set_key(static_cast<int>(i), domain.head->key);
            }
        }
    }
}

void BankCycles::end_pixels(Domain& domain, std::uint32_t mask) const {
    domain.ended |= mask;
    domain.live = sees_pixels_ || domain.ended == kAllPixels ? ~domain.ended : kAllPixels;
}

void BankCycles::end_pixels() {
    while (has_terminations<Kind::General>()) {
        end_pixels(terminations_.take(self_));
    }
}

void BankCycles::end_pixels(const Termination& message) {
    const int context = message.context - config_.first_context;
    const BankStream& stream = streams_[context / contexts_];
    const std::size_t turn = stream.turn_of(context % contexts_, contexts_);
    if (turn >= stream.first_unstarted() || tile_at(stream.index, turn).number != message.tile) {
        return; // the tile is over for this bank
    }
    Tile& tile = tile_at(stream.index, turn);
    const int number = segmenter_.domain_of(message.row, message.column);
    Domain& domain = tile.domains[number];
    end_pixels(domain, message.mask);
    if (domain.ended != kAllPixels) {
        return;
    }
    while (domain.head != nullptr) {
        features_.release(domain.head->feature, now_);
        drop(*domain.head, domain.head->mask);
        stats_.segments_dropped++;
        if (choice_ == Choice::InTurn) {
            pop<Choice::InTurn>(tile, number);
        } else {
            pop<Choice::Keyed>(tile, number);
        }
    }
    if (domain.held != 0) {
        domain.held = 0;
        pipeline_.remove({stream.index, turn, number});
    }
}

// Drops tasks of a segment whose pixels have all ended, and takes them out of the totals.
void BankCycles::drop(const Waiting& segment, std::uint32_t tasks) {
    stats_.tasks_dropped += __builtin_popcount(tasks);
    inside_ -= __builtin_popcount(tasks & segment.inside);
}

// A context comes back only after this bank, too, has ended the tile that holds it.
void BankCycles::see_contexts() {
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
void BankCycles::list_started() {
    for (Tile* const tile : started_) {
        tile->started = false;
    }
    started_.clear();
    issuable_ = 0;
    spans_from_ = 0;
    for (BankStream& stream : streams_) {
        stream.first_started = started_.size();
        for (std::size_t turn = stream.oldest; turn < stream.first_unstarted(); ++turn) {
            Tile& tile = tile_at(stream.index, turn);
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
std::uint32_t BankCycles::tasks_of(const Waiting& segment, std::uint32_t live) {
    const std::uint32_t wanted = segment.mask & live;
    return by_task_ && wanted != 0 ? segment.mask : wanted; // one live task takes the others along
}

// What the Packing Unit needs of a segment beside what the choice needs.
void BankCycles::keep_values(const Waiting& segment) {
    if (counts_) {
        return;
    }
    Values& values = values_[&segment - pool_.data()];
    values.splat = taken_span_.splat;
    if (slice_ != nullptr) {
        values.useful = row_useful_->from(column_);
        return;
    }
    values.g0 = taken_span_.g0;
    values.d0 = taken_span_.d0;
    values.offset = inside_tile(column_ - taken_span_.base);
}

TaskRun BankCycles::run_of(const Tile& tile, int number, const Waiting& segment) const {
    const Values& values = values_[&segment - pool_.data()];
    const Segmenter::Domain& place = segmenter_.domains()[number];
    TaskRun run;
    run.tile = tile.number;
    run.domain = number;
    run.task.g0 = values.g0;
    run.task.d0 = values.d0;
    run.task.splat = values.splat;
    run.task.mask = segment.mask;
    run.task.row = inside_tile(place.row);
    run.task.column = inside_tile(place.column);
    run.task.offset = values.offset;
    run.task.context = tile.context;
    run.outcome = {segment.inside, values.useful, segment.ended};
    return run;
}

// Tells the slice that pixels of a domain end with these tasks of a packet.
void BankCycles::end_replayed(const Tile& tile, int number, std::uint32_t tasks, Cycle date) {
    const Segmenter::Domain& place = segmenter_.domains()[number];
    TaskRun run;
    run.tile = tile.number;
    run.domain = number;
    run.task.row = inside_tile(place.row);
    run.task.column = inside_tile(place.column);
    run.task.context = tile.context;
    slice_->end_replayed(run, tasks, date);
}

void BankCycles::finish_tiles() {
    const std::size_t before = closing_;
    for (BankStream& stream : streams_) {
        finish_tiles(stream);
    }
    if (closing_ != before) {
        list_started();
    }
}

void BankCycles::finish_tiles(BankStream& stream) {
    while (stream.oldest < stream.entering && stream.oldest < stream.startable) {
        const Tile& tile = tile_at(stream.index, stream.oldest);
        if (tile.waiting != 0) {
            break;
        }
        if (log_ != nullptr) {
            log_->leave(now_, tile.number, tile.context);
        }
        packing_.end_tile(self_, tile.number, tile.context);
        tile_end_.count(tile.number);
        ++stream.oldest;
        --closing_;
        contexts_owed_ = true;
        contexts_from_ = 0;
    }
}

// Counts an end of tile `number` that an input has sent; with kNoTile the stream itself ends. A
// tile is over for the bank once all inputs of its stream have sent its end.
void BankCycles::take_end(BankStream& stream, TileNumber number) {
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

// All tasks that came in have been issued or dropped, if nothing waits. A useful task is never
// dropped.
void BankCycles::count_totals() {
    stats_.segments_issued = segments_in_ - stats_.segments_dropped;
    stats_.tasks_issued = stats_.tasks_in - stats_.tasks_dropped;
    if (!counts_) {
        return;
    }
    SlotAccount executed, more;
    executed[Slot::Useful] = useful_;
    executed[Slot::Boundary] = stats_.tasks_issued - inside_;
    executed[Slot::Terminated] = inside_ - useful_;
    for (const Slot slot : {Slot::Useful, Slot::Boundary, Slot::Terminated}) {
        more[slot] = executed[slot] - counted_[slot];
    }
    counted_ = executed;
    slice_->count_replayed(more);
}

void BankCycles::finish() {
    now_ = self_.local();
    packing_.send_due(self_, Slot::Starved);
    packing_.close_cycles(self_, now_ + 1, Slot::Starved);
    if (config_.granted) {
        packing_.end_tile(self_, kNoTile, 0);
    }
    count_totals();
    self_.finish();
}

} // namespace degs
