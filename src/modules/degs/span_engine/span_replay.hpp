// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/degs/span_engine/span_stage.hpp"

namespace degs {

class SpanTurns;

/// Replays rows that a FunctionalModel has rasterised on their way through a lane of the Span
/// Buffer, its Span Unit and its ring of the crossbar, where the unit reaches one bank. Every row
/// of a frame passes here, and the outcome of a row is known before it comes. So rows stay in the
/// place where the Slicing Unit has put them until the bank has cut them, and only dates are worked
/// out: when the lane has room, when the unit takes a row, when the crossbar has room for it, and
/// when the bank may read it. Dates and counts are those of SpanUnit and DatedFifo, which do the
/// same for all other designs and in strict mode. A unit that serves several streams takes their
/// rows in turn (SpanTurns).
///
/// The object itself is the ring that the bank reads; lane() is the one that the Slicing Unit
/// writes.
class SpanReplay final : public FifoBase, public Pumped {
public:
    static constexpr std::int16_t kEnd = -1;
    /// A row inside a tile, or the end of the tile.
    struct alignas(64) Row {
        RowMask inside, useful, ended; ///< see RowOutcome
        TileNumber tile = 0;
        std::uint32_t splat = 0;         ///< DataPath index
        std::int16_t x0 = 0, length = 0; ///< pixels; kEnd: the end of the tile
        std::int16_t row = 0;            ///< inside the tile
        bool end() const { return length == kEnd; }
    };

    /// Stands for what `unit` does with `rows` for `bank`. The rings `rows` and `ring` stay empty.
    SpanReplay(Process& unit, Process& bank, DatedFifo<RowItem>& rows, DatedFifo<SpanItem>& ring,
               const SpanStage::Config& config, SpanStage::Stats& stats, TileEnd& tiles);

    /// Has every row that the unit takes reported to `solved`; before the simulation starts.
    void report_to(DatedFifo<RowSolved>& solved) { solved_ = &solved; }
    /// Leaves it to `turns` to take the rows for the unit; before the simulation starts.
    void take_with(SpanTurns& turns) {
        turns_ = &turns;
        holding_ = true;
    }

    // For the Slicing Unit, see DatedFifo.
    FifoBase& lane() { return lane_; }
    /// Waits for a place in the lane and moves the writer to the date from which it is free.
    void reserve(Process& writer) {
        if (lane_.items() == span_ || reads_[(put_ - span_) & reads_mask_] > writer.local()) {
            make_room(writer);
        }
    }
    /// Puts a row of a splat into the lane, or the end of a tile. Call reserve() before.
    inline void put(Process& writer, TileNumber tile, std::uint32_t splat, int y,
                    const RowOutcome& outcome);
    void put_end(Process& writer, TileNumber tile);

    // For the bank.
    /// The oldest row that the bank has not taken. Only if not empty().
    const Row& front() const { return rows_[cells_[taken_ & mask_].row & rows_mask_]; }
    /// Removes the oldest row, which the bank has taken at `now`. The bank may still look at it
    /// until it takes the next one.
    inline void drop(Cycle now);
    /// Takes rows from the lane until it is empty, or the crossbar is full and the unit holds
    /// another span.
    void pump() override;

    // For SpanTurns. The lane's oldest item is a row or the end of a tile.
    std::size_t waiting() const { return lane_.items(); }
    Cycle lane_head() const { return lane_.head; } ///< date from which it may be taken
    bool next_ends() const { return rows_[(put_ - lane_.items()) & rows_mask_].end(); }
    /// Date from which the crossbar has room for the next item. Only if not full().
    Cycle room_date() const { return free_from_; }
    std::size_t room() const { return depth_ - filled_; }
    /// The oldest item leaves the lane. Returns its number.
    inline std::size_t leave(Cycle now);
    /// The unit takes the oldest item, a row, and sends its span, if it has one.
    inline void take_row(Cycle now);
    /// An item that has left the lane enters the crossbar.
    inline void send(std::size_t number, Cycle now);
    TileNumber tile_of(std::size_t number) const { return rows_[number & rows_mask_].tile; }

    /// What passed here in place of the ring of the crossbar, to be added to the ring's own counts.
    DatedFifo<SpanItem>::Stats counts() const {
        DatedFifo<SpanItem>::Stats counts = counts_;
        counts.items = taken_;
        return counts;
    }
    DatedFifo<RowItem>::Stats lane_counts() const {
        DatedFifo<RowItem>::Stats counts = lane_counts_;
        counts.items = put_ - lane_.items();
        return counts;
    }

    const char* fifo_name() const override { return ring_.fifo_name(); }
    Use use() const override { return ring_.use(); }
    Cycle residence(std::uint64_t items, Cycle date) const override {
        return ring_.residence(items, date);
    }

private:
    /// The lane as the Slicing Unit and the proofs of other processes see it.
    class Lane final : public FifoBase {
    public:
        explicit Lane(DatedFifo<RowItem>& ring)
            : FifoBase(ring.forward_latency(), ring.release_latency()), ring_(ring) {
            depth_ = ring.depth();
            room_ = depth_;
            head_ = &head;
            free_ = &free_from;
        }
        const char* fifo_name() const override { return ring_.fifo_name(); }
        Use use() const override { return ring_.use(); }
        Cycle residence(std::uint64_t items, Cycle date) const override {
            return ring_.residence(items, date);
        }
        std::size_t items() const { return filled_; }
        void enter() { ++filled_; }
        void leave() { --filled_; }

        Cycle head = 0;      // date from which the oldest item may be read
        Cycle free_from = 0; // of the next place, once the lane has been full

    private:
        DatedFifo<RowItem>& ring_;
    };
    struct Cell {
        Cycle date = 0; // from which the bank may read it
        Cycle read = 0; // by the bank
        std::size_t row = 0;
    };

    [[gnu::noinline]] void make_room(Process& writer);
    [[gnu::noinline]] void add_places();
    [[gnu::noinline]] void add_rows();
    inline Row& next_row();
    inline void enter(Cycle now);
    [[gnu::noinline]] void tell_unit();
    inline void count_taken(std::size_t number, Cycle written, Cycle now);
    inline void solve(std::size_t number, Cycle written);
    [[gnu::noinline]] void solve_other(std::size_t number, Cycle now);
    inline void hold(std::size_t number, Cycle now);
    inline void deliver(std::size_t number, Cycle now);
    void deliver_end(std::size_t number, Cycle now);

    Process& unit_;
    DatedFifo<SpanItem>& ring_;
    DatedFifo<SpanItem>::Stats counts_;
    DatedFifo<RowItem>::Stats lane_counts_;
    SpanStage::Stats& stats_;
    TileEnd& tiles_;
    DatedFifo<RowSolved>* solved_ = nullptr;
    SpanTurns* turns_ = nullptr; // null: the unit serves nobody else
    Cycle cycles_per_row_;
    // All rings have as many places as a power of two. Rows are numbered as they enter the lane.
    Lane lane_;
    std::vector<Row> rows_;      // from the one that the bank has taken last on
    std::vector<Cycle> entered_; // into the lane, of each
    std::size_t rows_mask_ = 0;
    std::vector<std::vector<Row>> left_; // outgrown arrays: the bank may still look at a row of one
    std::size_t put_ = 0;                // rows so far
    std::size_t kept_from_ = 0;          // the row that the bank has taken last
    std::vector<Cycle> reads_;           // of the item that has left a place of the lane last
    std::size_t reads_mask_ = 0;
    std::size_t span_ = 0;    // places of the lane so far
    std::vector<Cell> cells_; // of the crossbar
    std::size_t mask_ = 0;
    std::size_t made_ = 0, taken_ = 0; // so far
    Cycle free_from_ = 0;              // date from which the crossbar has room
    // The unit takes no row by itself: it serves others, too, or holds held_ because the crossbar
    // is full.
    bool holding_ = false;
    std::size_t held_ = 0;
};

inline __attribute__((always_inline)) SpanReplay::Row& SpanReplay::next_row() {
    if (put_ - kept_from_ == rows_.size()) {
        add_rows();
    }
    return rows_[put_ & rows_mask_];
}

inline __attribute__((always_inline)) void SpanReplay::put(Process& writer, TileNumber tile,
                                                           std::uint32_t splat, int y,
                                                           const RowOutcome& outcome) {
    Row& row = next_row();
    row.inside = outcome.inside;
    row.useful = outcome.useful;
    row.ended = outcome.ended;
    row.tile = tile;
    row.splat = splat;
    row.x0 = inside_tile(outcome.x0);
    row.length = inside_tile(outcome.length);
    row.row = inside_tile(y);
    enter(writer.local());
}

// An item enters the lane. The unit takes it at once, unless the unit holds another item; then the
// lane may have more items already.
inline __attribute__((always_inline)) void SpanReplay::enter(Cycle now) {
    const std::size_t number = put_++;
    if (!holding_) {
        solve(number, now);
        return;
    }
    entered_[number & rows_mask_] = now;
    if (lane_.items() == 0) {
        lane_.head = now + lane_.forward_latency();
    }
    lane_.enter();
    if (turns_ != nullptr) {
        tell_unit();
    }
}

inline __attribute__((always_inline)) void SpanReplay::count_taken(std::size_t number,
                                                                   Cycle written, Cycle now) {
    lane_counts_.occupied_cycles += now - written;
    // The mark rises by one where as many items as before it were still inside.
    const std::size_t mark = lane_counts_.high_water;
    if (mark != lane_.depth() && (mark == 0 || reads_[(number - mark) & reads_mask_] > written)) {
        lane_counts_.high_water = mark + 1;
    }
    reads_[number & reads_mask_] = now;
}

// The unit takes a row that was written at `written`.
inline __attribute__((always_inline)) void SpanReplay::solve(std::size_t number, Cycle written) {
    const Cycle free = unit_.local();
    const Cycle now = std::max(free, written + lane_.forward_latency());
    lane_counts_.empty_cycles += now - free;
    count_taken(number, written, now);
    const int length = rows_[number & rows_mask_].length;
    if (length <= 0 || solved_ != nullptr) {
        solve_other(number, now);
        return;
    }
    stats_.rows++;
    stats_.spans++;
    stats_.tasks += length;
    if (filled_ == depth_) {
        hold(number, now);
    } else {
        deliver(number, now);
    }
}

// The unit holds the span, because the crossbar is full.
inline __attribute__((always_inline)) void SpanReplay::hold(std::size_t number, Cycle now) {
    unit_.advance_to(now);
    holding_ = true;
    held_ = number;
    unit_.hold_for(this);
}

// A span enters the crossbar, which has room.
inline __attribute__((always_inline)) void SpanReplay::deliver(std::size_t number, Cycle now) {
    const Cycle written = std::max(now, cells_[(made_ - depth_) & mask_].read + release_latency_);
    counts_.full_cycles += written - now;
    Cell& cell = cells_[made_++ & mask_];
    cell.date = written + forward_latency_;
    cell.row = number;
    const bool was_empty = filled_++ == 0;
    stats_.busy += cycles_per_row_;
    unit_.advance_to(written + cycles_per_row_);
    if (was_empty && reader_->blocked()) {
        reader_->wake();
    }
}

inline __attribute__((always_inline)) std::size_t SpanReplay::leave(Cycle now) {
    const std::size_t number = put_ - lane_.items();
    const bool was_full = lane_.full();
    count_taken(number, entered_[number & rows_mask_], now);
    lane_.leave();
    lane_.head = entered_[(number + 1) & rows_mask_] + lane_.forward_latency();
    if (was_full) {
        lane_.free_from = now;
        if (lane_.writer()->blocked()) {
            lane_.writer()->wake();
        }
    }
    return number;
}

inline __attribute__((always_inline)) void SpanReplay::take_row(Cycle now) {
    const std::size_t number = leave(now);
    stats_.rows++;
    stats_.busy += cycles_per_row_;
    const int length = rows_[number & rows_mask_].length;
    if (length == 0) {
        stats_.empty_rows++;
        return;
    }
    stats_.spans++;
    stats_.tasks += length;
    send(number, now);
}

inline __attribute__((always_inline)) void SpanReplay::send(std::size_t number, Cycle now) {
    Cell& cell = cells_[made_++ & mask_];
    cell.date = now + forward_latency_;
    cell.row = number;
    free_from_ = cells_[(made_ - depth_) & mask_].read + release_latency_; // unless it is full
    if (filled_++ == 0 && reader_->blocked()) {
        reader_->wake();
    }
}

inline __attribute__((always_inline)) void SpanReplay::drop(Cycle now) {
    Cell& cell = cells_[taken_ & mask_];
    const Cycle written = cell.date - forward_latency_;
    counts_.occupied_cycles += now - written;
    const std::size_t mark = counts_.high_water;
    if (mark != depth_ && (mark == 0 || cells_[(taken_ - mark) & mask_].read > written)) {
        counts_.high_water = mark + 1;
    }
    cell.read = now;
    kept_from_ = cell.row;
    head_ = &cells_[++taken_ & mask_].date;
    if (filled_-- == depth_) {
        free_from_ = now + release_latency_;
        pump();
    }
}

} // namespace degs
