// SPDX-License-Identifier: Apache-2.0
#include "modules/scheduler/issue_bank.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace degs {
namespace {

// A queue may hold the next tile's segments while its context is still taken.
int tiles_in_queue(int contexts) {
    return std::max(2, contexts);
}

// The queue holds more when they come.
constexpr int kFirstTiles = 2;

} // namespace

IssueBank::IssueBank(const sc_core::sc_module_name& name, const Config& config,
                     const Timebase& time, const RenderJob& job, PackingUnit& packing, int index,
                     std::size_t inputs, int contexts)
    : sc_core::sc_module(name), in("in", inputs), terminated("terminated"),
      context_free("context_free"), config_(config), job_(job), packing_(packing),
      contexts_(contexts), tiles_in_flight_(tiles_in_queue(contexts)),
      by_pixel_(config.termination == TerminationGrain::Pixel), self_(time),
      segmenter_(job.tile_size, config.segment_length, index, config.count, contexts),
      queue_(config.queue_depth, kFirstTiles,
             Segmenter::domains_per_tile(job.tile_size, config.segment_length, config.count),
             config.scan),
      features_(config.feature_entries, config.open_splats), startable_(contexts) {
    SC_HAS_PROCESS(IssueBank);
    SC_THREAD(run);
}

void IssueBank::end_of_elaboration() {
    for (auto& port : in) {
        inputs_.push_back(&port.ring());
        inputs_.back()->connect_reader(self_);
    }
    terminations_ = &terminated.ring();
    terminations_->connect_reader(self_);
    contexts_freed_ = &context_free.ring();
    contexts_freed_->connect_reader(self_);
    packing_.out->connect_writer(self_);
    watched_.resize(inputs_.size() + 2);
}

void IssueBank::run() {
    while (!job_.over(oldest_tile_)) {
        const Cycle now = self_.local();
        see_terminations();
        see_contexts();
        accept(now);
        const bool worked = issue(now);
        const bool over = finish_tiles() && job_.over(oldest_tile_);
        if (packing_.due(now)) {
            packing_.send_due(self_, idle_cause());
        }
        Cycle next = now + 1;
        if (over) {
            const Cycle open = packing_.open_until();
            next = open == kNever ? next : std::max(open, next);
        } else if (!worked && !(segmenter_.cutting() && !queue_.full())) {
            next = next_date(now);
        } // else work is left, whatever arrives; proof is asked for where it matters
        if (packing_.leaves_slots(next)) {
            packing_.close_cycles(self_, next, idle_cause());
        }
        self_.advance_to(next);
    }
    packing_.send_due(self_, Idle::Starved);
    packing_.close_cycles(self_, self_.local() + 1, Idle::Starved);
    self_.finish();
}

void IssueBank::see_terminations() {
    while (self_.arrived(*terminations_)) {
        end_pixels(terminations_->take(self_));
    }
}

void IssueBank::see_contexts() {
    // A context comes back only after this bank, too, has ended the tile that holds it.
    while (startable_ < oldest_tile_ + contexts_ && self_.arrived(*contexts_freed_)) {
        startable_ = std::max(startable_, contexts_freed_->take(self_) + 1);
    }
}

void IssueBank::end_pixels(const Termination& message) {
    if (!in_flight(message.tile)) {
        return; // the tile is over for this bank
    }
    SegmentQueue::Tile& tile = queue_.tile(message.tile);
    const int domain = segmenter_.domain_of(message.row, message.column);
    if (end_pixels(tile, domain, message.mask) == kAllPixels) {
        while (tile.has_waiting(domain)) {
            const Segment& segment = tile.front(domain);
            features_.release(segment.feature, self_.local());
            drop(segment.run.task.mask);
            queue_.pop(tile, domain);
        }
    }
}

// All pixels of the domain that have ended. The bank looks at single pixels or at whole segments.
std::uint32_t IssueBank::end_pixels(SegmentQueue::Tile& tile, int domain,
                                    std::uint32_t mask) const {
    const std::uint32_t ended = tile.end_pixels(domain, mask);
    const bool all = ended == kAllPixels;
    tile.set_live(domain, by_pixel_ || all ? ~ended : kAllPixels);
    return ended;
}

// Called when the first item of a tile is taken. Pixels outside of the image count as ended.
void IssueBank::enter_tile() {
    queue_.hold(oldest_tile_, entering_tile_);
    const int width = job_.tiles[entering_tile_].width;
    SegmentQueue::Tile& tile = queue_.tile(entering_tile_);
    int domain = 0;
    for (const Segmenter::Domain& place : segmenter_.domains()) {
        const int inside = std::clamp(width - place.column, 0, config_.segment_length);
        end_pixels(tile, domain++, ~bits_between(0, inside));
    }
    entered_ = true;
}

void IssueBank::drop(std::uint32_t mask) {
    stats_.segments_dropped++;
    stats_.tasks_dropped += __builtin_popcount(mask);
}

void IssueBank::accept(Cycle now) {
    for (int budget = config_.segments_per_cycle; budget > 0; --budget) {
        if (!segmenter_.cutting() && !open_span(now)) {
            break;
        }
        if (!cut_segment()) {
            break;
        }
    }
}

// Takes the earliest span that has arrived, ties by input; tile ends on the way cost nothing.
bool IssueBank::open_span(Cycle now) {
    for (;;) {
        DatedFifo<SpanItem>* source = nullptr;
        for (DatedFifo<SpanItem>* input : inputs_) {
            if (self_.arrived(*input) && takes(input->front().tile) &&
                (source == nullptr || input->head_date() < source->head_date())) {
                source = input;
            }
        }
        if (source == nullptr) {
            return false;
        }
        const SpanItem& item = source->front();
        features_full_ = item.span && !features_.admit(item.tile, item.span->splat, now);
        if (features_full_) {
            return false;
        }
        if (!entered_) {
            enter_tile();
        }
        const bool span = item.span.has_value();
        if (span) {
            segmenter_.start(item);
            stats_.spans++;
            stats_.tasks_in += item.span->length;
        }
        source->drop(self_);
        if (span) {
            return true;
        }
        if (++ends_seen_ == inputs_.size()) {
            features_.close(now);
            ends_seen_ = 0;
            ++entering_tile_;
            entered_ = false;
        }
    }
}

// False if the queue has no room; the segment is then cut later.
bool IssueBank::cut_segment() {
    SegmentQueue::Tile& tile = queue_.tile(segmenter_.tile());
    const int domain = segmenter_.domain();
    const std::uint32_t mask = segmenter_.mask();
    if ((mask & tile.live(domain)) == 0) {
        drop(mask);
    } else {
        if (queue_.full()) {
            return false;
        }
        Segment& segment = queue_.push(tile, domain, sequence_++);
        segment.feature = features_.current();
        features_.hold(segment.feature);
        segmenter_.fill(segment.run, mask);
        if (queue_.size() > stats_.queue_high_water) {
            stats_.queue_high_water = queue_.size();
        }
    }
    segmenter_.next();
    return true;
}

// True if anything was issued.
bool IssueBank::issue(Cycle now) {
    no_room_ = false;
    width_limited_ = false;
    int issued = 0;
    const TileNumber end = first_unstarted();
    for (TileNumber number = oldest_tile_; number < end; ++number) {
        SegmentQueue::Tile& tile = queue_.tile(number);
        while (tile.waiting() != 0 && issue_one(now, tile)) {
            if (++issued == config_.issue_width) {
                width_limited_ = true;
                stats_.busy++;
                return true;
            }
        }
    }
    stats_.busy += issued != 0 ? 1 : 0;
    return issued != 0;
}

bool IssueBank::issue_one(Cycle now, SegmentQueue::Tile& tile) {
    const int domain = queue_.pick(tile, packing_.next_execution(now));
    if (domain < 0) {
        return false;
    }
    const Segment& segment = tile.front(domain);
    const std::uint32_t mask = segment.run.task.mask;
    const std::uint32_t wanted = mask & tile.live(domain);
    const int tasks = __builtin_popcount(wanted);
    if (!packing_.room(now, tasks)) {
        no_room_ = true;
        return false;
    }
    Cycle last = now;
    if (tasks != 0) {
        last = packing_.add(self_, segment.run, wanted) + config_.reuse_cycles;
        if (config_.scoreboard) {
            queue_.set_ready_at(tile, domain, last);
        }
    }
    stats_.segments_issued++;
    stats_.tasks_issued += tasks;
    stats_.tasks_dropped += __builtin_popcount(mask) - tasks;
    features_.release(segment.feature, last);
    queue_.pop(tile, domain);
    return true;
}

// True if a tile has ended.
bool IssueBank::finish_tiles() {
    const TileNumber before = oldest_tile_;
    while (oldest_tile_ < entering_tile_ && !job_.over(oldest_tile_) && oldest_tile_ < startable_ &&
           queue_.tile(oldest_tile_).waiting() == 0 &&
           !(segmenter_.cutting() && segmenter_.tile() == oldest_tile_)) {
        packing_.end_tile(self_, oldest_tile_);
        queue_.clear(queue_.tile(oldest_tile_));
        ++oldest_tile_;
    }
    return oldest_tile_ != before;
}

Idle IssueBank::idle_cause() const {
    if (queue_.empty()) {
        return Idle::Starved;
    }
    const TileNumber end = first_unstarted();
    for (TileNumber tile = oldest_tile_; tile < end; ++tile) {
        if (queue_.tile(tile).waiting() != 0) {
            return width_limited_ ? Idle::Starved : no_room_ ? Idle::Blocked : Idle::Conflict;
        }
    }
    return Idle::Blocked;
}

// The next date at which waiting segments may go, if none went at `now`; kNever if none waits.
Cycle IssueBank::next_ready(Cycle now) const {
    if (no_room_) {
        return now + 1;
    }
    Cycle earliest = kNever;
    const TileNumber end = first_unstarted();
    for (TileNumber number = oldest_tile_; number < end; ++number) {
        const SegmentQueue::Tile& tile = queue_.tile(number);
        if (tile.waiting() != 0) {
            earliest = std::min(earliest, queue_.next_ready(tile));
        }
    }
    return earliest;
}

// The next cycle in which anything can change, if there is nothing left to do at once: a domain
// becomes ready, an open packet has to leave, a Feature Buffer entry is freed, or a message
// arrives.
Cycle IssueBank::next_date(Cycle now) {
    const Cycle next = now + 1;
    Cycle limit = packing_.open_until();
    const Cycle latency = packing_.next_execution(now) - now;
    const Cycle ready = next_ready(now);
    if (ready != kNever) {
        limit = std::min(limit, std::max(next, ready > latency ? ready - latency : 0));
    }
    if (limit == next) {
        return next; // there is work then, whatever arrives
    }
    std::size_t watched = 0;
    if (!queue_.full() && !segmenter_.cutting()) {
        bool spans_waiting = false;
        for (DatedFifo<SpanItem>* input : inputs_) {
            if (input->empty()) {
                watched_[watched++] = input;
            } else if (takes(input->front().tile)) {
                if (input->head_date() > now) {
                    watched_[watched++] = input;
                } else {
                    spans_waiting = true;
                }
            }
        }
        if (spans_waiting) { // more than a cycle's worth, or no Feature Buffer entry
            limit = std::min(limit, features_full_ ? std::max(next, features_.next_free()) : next);
        }
    }
    watched_[watched++] = terminations_;
    // A context comes back only after this bank, too, has ended the tile that holds it.
    if (startable_ < oldest_tile_ + contexts_) {
        watched_[watched++] = contexts_freed_;
    }
    limit = self_.next_arrival(watched_.data(), watched, next, std::max(next, limit));
    if (limit >= kNever) {
        throw std::logic_error(std::string(name()) + ": nothing left to wait for, but tile " +
                               std::to_string(oldest_tile_) + " is not finished");
    }
    return limit;
}

} // namespace degs
