// SPDX-License-Identifier: Apache-2.0
#include "modules/issue_bank.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace degs {
namespace {

// A queue may hold the next tile's segments while its context is still taken.
int tiles_in_queue(int contexts) {
    return std::max(2, contexts);
}

int power_of_two(int least) {
    int size = 1;
    while (size < least) {
        size *= 2;
    }
    return size;
}

std::uint32_t bits(int begin, int end) {
    const auto upto = [](int n) { return n >= 32 ? ~0U : (1U << n) - 1U; };
    return upto(end) & ~upto(begin);
}

} // namespace

IssueBank::IssueBank(const sc_core::sc_module_name& name, const Config& config,
                     const Timebase& time, const RenderJob& job, int index, std::size_t inputs,
                     int contexts)
    : sc_core::sc_module(name), in("in", inputs), terminated("terminated"),
      context_free("context_free"), config_(config), job_(job), contexts_(contexts),
      tiles_in_flight_(tiles_in_queue(contexts)),
      slot_mask_(static_cast<TileNumber>(power_of_two(tiles_in_flight_)) - 1),
      segments_per_row_((job.tile_size + config.segment_length - 1) / config.segment_length),
      self_(time), queue_(config.queue_depth, power_of_two(tiles_in_flight_),
                          (job.tile_size + config.count - 1) / config.count * segments_per_row_),
      features_(config.feature_entries), startable_(static_cast<TileNumber>(contexts)) {
    for (int row = 0; row < job.tile_size; ++row) {
        first_domain_of_row_.push_back(row / config.count * segments_per_row_);
        segment_of_column_.push_back(row / config.segment_length);
    }
    for (int row = index; row < job.tile_size; row += config.count) {
        for (int s = 0; s < segments_per_row_; ++s) {
            domains_.push_back({static_cast<std::int16_t>(row),
                                static_cast<std::int16_t>(s * config.segment_length)});
        }
    }
    inside_.resize(domains_.size() * (slot_mask_ + 1));
    SC_HAS_PROCESS(IssueBank);
    SC_THREAD(run);
}

void IssueBank::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
    }
    terminated->connect_reader(self_);
    context_free->connect_reader(self_);
    packing->out->connect_writer(self_);
}

void IssueBank::run() {
    while (oldest_tile_ < job_.tiles.size()) {
        const Cycle now = self_.local();
        see_terminations();
        see_contexts();
        accept(now);
        const bool worked = issue(now) != 0;
        finish_tiles();
        if (packing->due(now)) {
            packing->send_due(self_, idle_cause());
        }
        const Cycle open = packing->open_until();
        const Cycle next = oldest_tile_ < job_.tiles.size() ? next_date(now, worked)
                           : open == kNever                 ? now + 1
                                                            : std::max(open, now + 1);
        if (next >= kNever) {
            throw std::logic_error(std::string(name()) + ": nothing left to wait for, but tile " +
                                   std::to_string(oldest_tile_) + " is not finished");
        }
        packing->close_cycles(self_, next,
                              packing->leaves_slots(next) ? idle_cause() : Idle::Starved);
        self_.advance_to(next);
    }
    packing->send_due(self_, Idle::Starved);
    packing->close_cycles(self_, self_.local() + 1, Idle::Starved);
    self_.finish();
}

void IssueBank::see_terminations() {
    while (self_.arrived(*terminated.operator->())) {
        end_pixels(terminated->take(self_));
    }
}

void IssueBank::see_contexts() {
    // A context comes back only after this bank, too, has ended the tile that holds it.
    while (startable_ < oldest_tile_ + static_cast<TileNumber>(contexts_) &&
           self_.arrived(*context_free.operator->())) {
        startable_ = std::max(startable_, context_free->take(self_) + 1);
    }
}

void IssueBank::end_pixels(const Termination& message) {
    if (!in_flight(message.tile)) {
        return; // the tile is over for this bank
    }
    const int slot = slot_of(message.tile);
    const int domain = domain_of(message.row, message.column);
    queue_.end_pixels(slot, domain, message.mask);
    if (region_ended(message.tile, domain)) {
        while (queue_.has_waiting(slot, domain)) {
            const Segment& segment = queue_.front(slot, domain);
            features_.release(segment.feature, self_.local());
            drop(segment.mask);
            queue_.pop(slot, domain);
        }
    }
}

bool IssueBank::region_ended(TileNumber tile, int domain) {
    const std::uint32_t pixels = inside(tile, domain);
    return (queue_.ended(slot_of(tile), domain) & pixels) == pixels;
}

// Called when the first item of a tile is taken.
void IssueBank::enter_tile() {
    const int width = job_.tiles[entering_tile_].width;
    for (std::size_t d = 0; d < domains_.size(); ++d) {
        inside(entering_tile_, static_cast<int>(d)) =
            bits(0, std::clamp(width - domains_[d].column, 0, config_.segment_length));
    }
    entered_ = true;
}

void IssueBank::drop(std::uint32_t mask) {
    stats_.segments_dropped++;
    stats_.tasks_dropped += static_cast<std::uint64_t>(__builtin_popcount(mask));
}

void IssueBank::accept(Cycle now) {
    for (int budget = config_.segments_per_cycle; budget > 0; --budget) {
        if (!cutting_ && !open_span(now)) {
            break;
        }
        if (!cut_segment()) {
            break;
        }
    }
    stats_.queue_high_water = std::max<std::uint64_t>(stats_.queue_high_water, queue_.size());
}

// Takes the earliest span that has arrived, ties by input; tile ends on the way cost nothing.
bool IssueBank::open_span(Cycle now) {
    for (;;) {
        FifoPort<SpanItem>* source = nullptr;
        for (auto& port : in) {
            if (self_.arrived(*port.operator->()) && takes(port->front().tile) &&
                (source == nullptr || port->head_date() < (*source)->head_date())) {
                source = &port;
            }
        }
        if (source == nullptr) {
            return false;
        }
        const SpanItem& item = (*source)->front();
        features_full_ = !item.end && !features_.admit(item.tile, item.span.splat, now);
        if (features_full_) {
            return false;
        }
        if (!entered_) {
            enter_tile();
        }
        span_ = item;
        (*source)->drop(self_);
        if (!span_.end) {
            break;
        }
        if (++ends_seen_ == static_cast<int>(in.size())) {
            features_.close(now);
            ends_seen_ = 0;
            ++entering_tile_;
            entered_ = false;
        }
    }
    cutting_ = true;
    cut_x_ = span_.span.x0;
    stats_.spans++;
    stats_.tasks_in += static_cast<std::uint64_t>(span_.span.length);
    return true;
}

bool IssueBank::cut_segment() {
    const int slot = slot_of(span_.tile);
    const int column =
        segment_of_column_[static_cast<std::size_t>(cut_x_)] * config_.segment_length;
    const int span_end = span_.span.x0 + span_.span.length;
    const int domain = domain_of(span_.span.y, column);
    const std::uint32_t mask =
        bits(cut_x_ - column, std::min(span_end - column, config_.segment_length));
    const std::uint32_t live =
        config_.termination == TerminationGrain::Pixel ? mask & ~queue_.ended(slot, domain) : mask;
    if (live == 0 || region_ended(span_.tile, domain)) {
        drop(mask);
    } else {
        if (queue_.full()) {
            return false;
        }
        Segment segment;
        segment.g0 = span_.span.g0;
        segment.d0 = span_.span.d0;
        segment.splat = span_.span.splat;
        segment.mask = mask;
        segment.offset = static_cast<std::int16_t>(column - span_.span.x0);
        segment.feature = features_.current();
        segment.sequence = sequence_++;
        features_.hold(segment.feature);
        queue_.push(slot, domain, segment);
    }
    cut_x_ = column + config_.segment_length;
    cutting_ = cut_x_ < span_end;
    return true;
}

int IssueBank::issue(Cycle now) {
    wait_until_ = kNever;
    width_limited_ = false;
    int issued = 0;
    for (TileNumber tile = oldest_tile_;
         tile < startable_ && in_flight(tile) && issued < config_.issue_width;) {
        if (queue_.waiting(slot_of(tile)) != 0 && issue_one(now, tile)) {
            ++issued;
        } else {
            ++tile;
        }
    }
    width_limited_ = issued == config_.issue_width;
    stats_.busy += issued != 0 ? 1 : 0;
    return issued;
}

bool IssueBank::issue_one(Cycle now, TileNumber tile) {
    const int slot = slot_of(tile);
    const Cycle execution = packing->next_execution(now);
    const int domain = queue_.pick(slot, execution, config_.scan);
    if (domain < 0) {
        wait_until_ = std::min(wait_until_, queue_.next_ready(slot));
        return false;
    }
    const Segment& segment = queue_.front(slot, domain);
    TaskRun run;
    BlendTask& task = run.task;
    task.mask = config_.termination == TerminationGrain::Pixel
                    ? segment.mask & ~queue_.ended(slot, domain)
                    : segment.mask;
    const int tasks = __builtin_popcount(task.mask);
    if (!packing->room(now, tasks)) {
        wait_until_ = now + 1;
        return false;
    }
    Cycle last = now;
    if (tasks != 0) {
        task.g0 = segment.g0;
        task.d0 = segment.d0;
        task.splat = segment.splat;
        task.row = domains_[static_cast<std::size_t>(domain)].row;
        task.column = domains_[static_cast<std::size_t>(domain)].column;
        task.offset = segment.offset;
        task.context = static_cast<std::int16_t>(tile % static_cast<TileNumber>(contexts_));
        run.tile = tile;
        run.domain = static_cast<std::uint32_t>(domain);
        last = packing->add(self_, run) + static_cast<Cycle>(config_.reuse_cycles);
        if (config_.scoreboard) {
            queue_.set_ready_at(slot, domain, last);
        }
    }
    stats_.segments_issued++;
    stats_.tasks_issued += static_cast<std::uint64_t>(tasks);
    stats_.tasks_dropped += static_cast<std::uint64_t>(__builtin_popcount(segment.mask) - tasks);
    features_.release(segment.feature, last);
    queue_.pop(slot, domain);
    return true;
}

void IssueBank::finish_tiles() {
    while (oldest_tile_ < job_.tiles.size() && oldest_tile_ < entering_tile_ &&
           oldest_tile_ < startable_ && queue_.waiting(slot_of(oldest_tile_)) == 0 &&
           !(cutting_ && span_.tile == oldest_tile_)) {
        packing->end_tile(self_, oldest_tile_);
        queue_.clear(slot_of(oldest_tile_));
        ++oldest_tile_;
    }
}

Idle IssueBank::idle_cause() const {
    if (queue_.empty()) {
        return Idle::Starved;
    }
    for (TileNumber tile = oldest_tile_; tile < startable_ && in_flight(tile); ++tile) {
        if (queue_.waiting(slot_of(tile)) != 0) {
            return width_limited_ ? Idle::Starved : Idle::Conflict;
        }
    }
    return Idle::Blocked;
}

// The next cycle in which anything can change: at once if work is left for it, else when a domain
// becomes ready, an open packet has to leave, a Feature Buffer entry is freed, or a message
// arrives.
Cycle IssueBank::next_date(Cycle now, bool worked) {
    const Cycle next = now + 1;
    Cycle limit = worked || (cutting_ && !queue_.full()) ? next : packing->open_until();
    const Cycle latency = packing->next_execution(now) - now;
    if (wait_until_ != kNever) {
        limit = std::min(limit, std::max(next, wait_until_ > latency ? wait_until_ - latency : 0));
    }
    if (limit == next) {
        return next; // there is work then, whatever arrives; proof is asked for where it matters
    }
    watched_.clear();
    if (!queue_.full() && !cutting_) {
        bool spans_waiting = false;
        for (auto& port : in) {
            spans_waiting = spans_waiting || (!port->empty() && takes(port->front().tile) &&
                                              port->head_date() <= now);
            if (port->empty() || (takes(port->front().tile) && port->head_date() > now)) {
                watched_.push_back(port.operator->());
            }
        }
        if (spans_waiting) { // more than a cycle's worth, or no Feature Buffer entry
            limit = std::min(limit, features_full_ ? std::max(next, features_.next_free()) : next);
        }
    }
    watched_.push_back(terminated.operator->());
    // A context comes back only after this bank, too, has ended the tile that holds it.
    if (startable_ < oldest_tile_ + static_cast<TileNumber>(contexts_)) {
        watched_.push_back(context_free.operator->());
    }
    return self_.next_arrival(watched_.data(), watched_.size(), next, std::max(next, limit));
}

} // namespace degs
