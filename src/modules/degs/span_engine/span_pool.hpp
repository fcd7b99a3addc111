// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "modules/degs/span_engine/span_replay.hpp"
#include "modules/degs/span_engine/span_stage.hpp"
#include "modules/degs/span_engine/span_turns.hpp"

namespace degs {

/// Span Units that share lanes: one unit that serves several tile streams, or a pool of units that
/// take rows of any lane. In each cycle the free units take rows from the lanes in turn, from each
/// lane in order. A row is taken only when the crossbar has a place for its Span Vector, which a
/// unit knows in the cycle after the bank has freed it, so a lane that has to wait holds up no
/// other. All Span Vectors of a stream for one bank go through one queue, which keeps the order of
/// splats within a row.
class SpanPool : public SpanStage {
public:
    /// The part of the stage that the module is: which lanes, streams and banks it serves.
    struct Share {
        int index = 0, of = 1; ///< it reaches the banks that share a row with part `index` of `of`
        int banks = 1;
        int streams = 1;
        int lanes = 1; ///< of a stream
        int units = 1;
    };
    SpanPool(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
             const RenderJob& job, const Share& share);

    /// Replays are possible only if the module has one unit, which takes a row per cycle from one
    /// lane per stream and reaches one bank alone.
    const std::vector<std::unique_ptr<SpanReplay>>& hand_over(Process& bank) override;

private:
    struct Stream {
        std::vector<DatedFifo<SpanItem>*> rings;       // by port
        std::vector<DatedFifo<SpanItem>*> ring_of_row; // by row inside the tile
        std::size_t turn = 0;                          // ends of tiles that have been sent
        std::size_t ends = 0;                          // lanes that have delivered the next one
        std::optional<TileNumber> ending;              // the tile whose end has to be sent
        std::size_t end_port = 0;                      // to which port
    };
    struct Lane {
        DatedFifo<RowItem>* rows = nullptr;
        Stream* stream = nullptr;
        DatedFifo<SpanItem>* const* ring_of_row = nullptr; // by row inside the tile
        Lane* next = nullptr;                              // in turn
        std::size_t turn = 0;                              // ends of tiles that it has delivered
        Cycle read = 0;                                    // date of the latest read
        int reads = 0;                                     // at that date
        bool has_row = false;   // the next item is known to be a row that has arrived
        bool looked_at = false; // at this date, and nothing has changed since then
    };

    void end_of_elaboration() override;
    void start_of_simulation() override;
    void run();
    void take_rows();
    inline int take_for_unit();
    inline bool take_from(Lane& lane);
    void look_at(Lane& lane);
    // What is rare stays out of the loop over cycles, which then keeps more in registers.
    [[gnu::noinline]] void pass_end(Lane& lane);
    bool send_end(Stream& stream);
    bool has_port(Lane& lane);
    Cycle next_date();

    Process self_;
    Share share_;
    std::vector<Lane> lanes_;
    std::vector<Stream> streams_;
    Lane* next_lane_ = nullptr;    // from which a row is taken next
    std::vector<Cycle> free_from_; // by unit
    bool waiting_ = false;         // a row or an end waits for a place in the crossbar
    bool ends_passed_ = false;     // since a unit began to look for rows
    std::vector<FifoBase*> watched_;
    std::unique_ptr<SpanTurns> turns_; // what does all of this once rows are handed over
};

} // namespace degs
