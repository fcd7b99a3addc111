// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/degs/span_engine/span_stage.hpp"

namespace degs {

/// A Span Unit and its ring of the crossbar, where rows come drawn (TileDrawing) and the unit
/// reaches one bank: a single ring of small cells, because every row of a frame passes here. What
/// is in the cells was drawn before; when the unit takes a row from its lane, when the crossbar has
/// room for it, and when the bank may read it, is worked out here. Dates and counts are those of
/// SpanUnit and DatedFifo, which do the same for all other designs and in strict mode.
class DrawnSpans final : public FifoBase, public Pumped {
public:
    /// A row that covers pixels of its tile, or the end of a tile.
    struct alignas(64) Span {
        Cycle date = 0;    ///< from which the bank may read it
        Cycle written = 0; ///< into the crossbar
        Cycle read = 0;    ///< by the bank
        DrawnRow drawn;
        TileNumber tile = 0;
        std::uint32_t splat = 0; ///< DataPath index
        std::int16_t row = 0;    ///< inside the tile
        bool end = false;        ///< end of the tile instead of a row
    };

    /// What `unit` does with `rows` for `bank`. `ring` stays empty.
    DrawnSpans(Process& unit, Process& bank, DatedFifo<RowItem>& rows, DatedFifo<SpanItem>& ring,
               const SpanStage::Config& config, SpanStage::Stats& stats, TileEnd& tiles);

    /// Tells of every row that the unit has taken; before the simulation starts.
    void report_to(DatedFifo<RowSolved>& solved) { solved_ = &solved; }
    /// The oldest one. Only if not empty().
    const Span& front() const { return cells_[taken_ & mask_]; }
    /// The bank has taken the oldest one at `now`. It may still be looked at until the next one is
    /// taken.
    inline void drop(Cycle now);
    /// Takes rows from the lane until it is empty, or the crossbar is full and the unit holds
    /// another span.
    void pump() override;

    /// To be added to those of the ring.
    const DatedFifo<SpanItem>::Stats& counts() const { return counts_; }

    const char* fifo_name() const override { return ring_.fifo_name(); }
    Use use() const override { return ring_.use(); }
    Cycle residence(std::uint64_t items, Cycle date) const override {
        return ring_.residence(items, date);
    }

private:
    inline void take();
    inline bool deliver();

    Process& unit_;
    DatedFifo<RowItem>& rows_;
    DatedFifo<SpanItem>& ring_;
    DatedFifo<SpanItem>::Stats counts_;
    SpanStage::Stats& stats_;
    TileEnd& tiles_;
    DatedFifo<RowSolved>* solved_ = nullptr;
    Cycle cycles_per_row_;
    // As many as a power of two: also the one taken last, and the one that the unit holds.
    std::vector<Span> cells_;
    std::size_t mask_ = 0;
    std::size_t made_ = 0, taken_ = 0; // so far
    Cycle room_ = 0;                   // date from which the crossbar has had room again
    bool holding_ = false;
};

inline __attribute__((always_inline)) void DrawnSpans::drop(Cycle now) {
    Span& span = cells_[taken_ & mask_];
    counts_.items++;
    counts_.occupied_cycles += now - span.written;
    // The mark rises by one where as many spans as before it were still inside.
    const std::size_t mark = counts_.high_water;
    if (mark != depth_ && (mark == 0 || cells_[(taken_ - mark) & mask_].read > span.written)) {
        counts_.high_water = mark + 1;
    }
    span.read = now;
    head_ = &cells_[++taken_ & mask_].date;
    if (filled_-- == depth_) {
        room_ = now + release_latency_;
        pump();
    }
}

} // namespace degs
