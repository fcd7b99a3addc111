// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/span_replay.hpp"

#include <algorithm>
#include <utility>

#include "modules/degs/span_engine/span_turns.hpp"

namespace degs {
namespace {

constexpr std::size_t kFirstPlaces = 16;

std::size_t power_of_two_from(std::size_t least) {
    std::size_t size = 1;
    while (size < least) {
        size *= 2;
    }
    return size;
}

} // namespace

SpanReplay::SpanReplay(Process& unit, Process& bank, DatedFifo<RowItem>& rows,
                       DatedFifo<SpanItem>& ring, const SpanStage::Config& config,
                       SpanStage::Stats& stats, TileEnd& tiles)
    : FifoBase(ring.forward_latency(), ring.release_latency()), unit_(unit), ring_(ring),
      stats_(stats), tiles_(tiles), cycles_per_row_(config.cycles_per_row), lane_(rows) {
    depth_ = ring.depth();
    cells_.resize(power_of_two_from(depth_));
    mask_ = cells_.size() - 1;
    rows_.resize(kFirstPlaces);
    entered_.resize(kFirstPlaces);
    rows_mask_ = rows_.size() - 1;
    reads_.resize(std::min(kFirstPlaces, power_of_two_from(lane_.depth())));
    reads_mask_ = reads_.size() - 1;
    span_ = std::min(reads_.size(), lane_.depth());
    head_ = &cells_.front().date;
    room_ = depth_;
    free_ = &free_from_;
    lane_.connect_writer(*rows.writer());
    lane_.connect_reader(unit);
    connect_writer(unit);
    connect_reader(bank);
}

// The lane is full, or its next place was read later than the writer's date. The host adds places
// as they are needed.
void SpanReplay::make_room(Process& writer) {
    if (span_ < lane_.depth()) {
        add_places();
        return;
    }
    if (turns_ != nullptr) {
        turns_->pump();
    }
    while (lane_.full()) {
        writer.block_on_room(lane_);
    }
    writer.advance_to(reads_[(put_ - span_) & reads_mask_], lane_counts_.full_cycles);
}

// A place of the lane keeps the date at which an item left it last. That item is the one with the
// place's number, or the one that lay there before it.
void SpanReplay::add_places() {
    std::vector<Cycle> more(2 * reads_.size());
    const std::size_t mask = more.size() - 1;
    const std::size_t unread = put_ - lane_.items();
    for (std::size_t i = put_ < reads_.size() ? 0 : put_ - reads_.size(); i < put_; ++i) {
        more[(i < unread ? i : i - reads_.size()) & mask] = reads_[i & reads_mask_];
    }
    reads_ = std::move(more);
    reads_mask_ = mask;
    span_ = std::min(reads_.size(), lane_.depth());
}

void SpanReplay::add_rows() {
    std::vector<Row> more(2 * rows_.size());
    std::vector<Cycle> entered(more.size());
    const std::size_t mask = more.size() - 1;
    for (std::size_t i = kept_from_; i < put_; ++i) {
        more[i & mask] = rows_[i & rows_mask_];
        entered[i & mask] = entered_[i & rows_mask_];
    }
    left_.push_back(std::move(rows_));
    rows_ = std::move(more);
    entered_ = std::move(entered);
    rows_mask_ = mask;
}

void SpanReplay::put_end(Process& writer, TileNumber tile) {
    Row& row = next_row();
    row.tile = tile;
    row.length = kEnd;
    enter(writer.local());
}

void SpanReplay::tell_unit() {
    if (turns_->waits_for(*this)) {
        turns_->pump();
    }
}

void SpanReplay::pump() {
    if (turns_ != nullptr) { // SpanTurns takes the rows, once somebody needs what follows
        turns_->has_room();
        if (lane_.full()) {
            turns_->pump();
        }
        return;
    }
    if (!holding_ || filled_ == depth_) {
        return;
    }
    holding_ = false;
    if (rows_[held_ & rows_mask_].end()) {
        deliver_end(held_, unit_.local());
    } else {
        deliver(held_, unit_.local());
    }
    while (lane_.items() != 0 && !holding_) {
        const std::size_t number = put_ - lane_.items();
        const bool was_full = lane_.full();
        lane_.leave();
        lane_.head = entered_[(number + 1) & rows_mask_] + lane_.forward_latency();
        solve(number, entered_[number & rows_mask_]);
        if (was_full) {
            lane_.free_from = reads_[number & reads_mask_];
            if (lane_.writer()->blocked()) {
                lane_.writer()->wake();
            }
        }
    }
    if (!holding_) {
        unit_.hold_for(nullptr);
    }
}

// The end of a tile, a row that misses every pixel of it, which costs its cycles and goes nowhere,
// or one that is reported.
void SpanReplay::solve_other(std::size_t number, Cycle now) {
    unit_.advance_to(now);
    const Row& row = rows_[number & rows_mask_];
    if (!row.end()) {
        if (solved_ != nullptr) {
            solved_->put(unit_, {});
        }
        stats_.rows++;
        if (row.length == 0) {
            stats_.empty_rows++;
            unit_.work(cycles_per_row_, stats_.busy);
            return;
        }
        stats_.spans++;
        stats_.tasks += row.length;
    }
    if (filled_ == depth_) {
        hold(number, now);
    } else if (row.end()) {
        deliver_end(number, now);
    } else {
        deliver(number, now);
    }
}

void SpanReplay::deliver_end(std::size_t number, Cycle now) {
    const Cycle written = std::max(now, cells_[(made_ - depth_) & mask_].read + release_latency_);
    counts_.full_cycles += written - now;
    unit_.advance_to(written);
    Cell& cell = cells_[made_++ & mask_];
    cell.date = written + forward_latency_;
    cell.row = number;
    if (filled_++ == 0 && reader_->blocked()) {
        reader_->wake();
    }
    tiles_.count(rows_[number & rows_mask_].tile);
    if (tiles_.over()) {
        unit_.finish();
    }
}

} // namespace degs
