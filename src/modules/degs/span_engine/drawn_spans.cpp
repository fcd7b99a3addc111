// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/drawn_spans.hpp"

namespace degs {

DrawnSpans::DrawnSpans(Process& unit, Process& bank, DatedFifo<RowItem>& rows,
                       DatedFifo<SpanItem>& ring, const SpanStage::Config& config,
                       SpanStage::Stats& stats, TileEnd& tiles)
    : FifoBase(ring.forward_latency(), ring.release_latency()), unit_(unit), rows_(rows),
      ring_(ring), stats_(stats), tiles_(tiles), cycles_per_row_(config.cycles_per_row) {
    depth_ = ring.depth();
    std::size_t size = 1;
    while (size < depth_ + 2) { // the span taken last and the one that the unit holds are beside
        size *= 2;
    }
    cells_.resize(size);
    mask_ = size - 1;
    head_ = &cells_.front().date;
    free_ = &room_;
    connect_writer(unit);
    connect_reader(bank);
}

void DrawnSpans::pump() {
    while ((!holding_ || deliver()) && !rows_.empty()) {
        take();
    }
}

// A row that misses every pixel of the tile costs its cycles and goes nowhere.
inline __attribute__((always_inline)) void DrawnSpans::take() {
    const RowItem& item = rows_.arrive(unit_);
    Span& span = cells_[made_ & mask_];
    span.drawn = item.drawn;
    span.tile = item.tile;
    span.splat = item.splat;
    span.row = item.row;
    span.end = item.end;
    rows_.drop(unit_);
    holding_ = true;
    if (span.end) {
        return;
    }
    if (solved_ != nullptr) {
        solved_->put(unit_, {});
    }
    stats_.rows++;
    if (span.drawn.length == 0) {
        holding_ = false;
        stats_.empty_rows++;
        unit_.work(cycles_per_row_, stats_.busy);
        return;
    }
    stats_.spans++;
    stats_.tasks += span.drawn.length;
}

// Hands over the span that is held; false if the crossbar has no room yet.
inline __attribute__((always_inline)) bool DrawnSpans::deliver() {
    if (filled_ == depth_) {
        unit_.hold_for(this);
        return false;
    }
    unit_.hold_for(nullptr);
    unit_.advance_to(cells_[(made_ - depth_) & mask_].read + release_latency_, counts_.full_cycles);
    Span& span = cells_[made_++ & mask_];
    holding_ = false;
    span.written = unit_.local();
    span.date = span.written + forward_latency_;
    if (filled_++ == 0 && reader_->blocked()) {
        reader_->wake();
    }
    if (!span.end) {
        unit_.work(cycles_per_row_, stats_.busy);
    } else {
        tiles_.count(span.tile);
        if (tiles_.over()) {
            unit_.finish();
        }
    }
    return true;
}

} // namespace degs
