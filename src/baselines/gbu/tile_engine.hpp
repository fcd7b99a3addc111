// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <systemc>

#include "baselines/gbu/engine_record.hpp"
#include "config/config.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/slot_account.hpp"
#include "stats/statistics.hpp"

namespace degs::gbu {

/// One row-centric tile engine of GBU: Row Generation and a Row PE per tile row, each with a queue
/// of row entries. Generation takes one listed splat per cycle at most, solves the interval of
/// pixels with alpha >= 1/255 of `rows_per_cycle` of its rows per cycle and pushes an entry to the
/// queue of each, per row as soon as there is room; the splat is finished when all its rows are
/// pushed. A Row PE walks its interval a pixel per cycle and finds its end by a failing check
/// (`end_probe`). Rows are bound to PEs; a tile ends when generation has finished and all queues
/// are empty.
///
/// GBU makes the conic a circle and turns it so that a row is parallel to an axis, which leaves
/// x''^2 <= threshold - y''^2 per pixel. That is the completed square of DataPath::test, so an
/// entry holds exactly the pixels that pass the Row PE's own check, in every number format.
///
/// An entry is evaluated when it is pushed: a Row PE depends on nothing but its own queue, so the
/// dates of the entry's slots follow from those of the entries before it, and it is already known
/// whether the row ends before it. A Row PE drops the entries of a row whose pixels have all ended
/// at no cost; generation sees it `termination_cycles` later and leaves the row out. Pixel updates
/// that follow each other closely are forwarded inside the Row PE [assumed].
class TileEngine : public sc_core::sc_module {
public:
    struct Config {
        int row_pes = 32;           ///< Row PEs; PE k serves the tile rows k, k + row_pes, ...
        int queue_depth = 16;       ///< entries waiting in front of a Row PE
        int rows_per_cycle = 4;     ///< of a splat, solved by Row Generation; 0: all of them
        int generation_latency = 8; ///< cycles from a splat's record to its entries
        int row_pe_latency = 10;    ///< cycles from a pixel's slot to its written-back state
        int termination_cycles = 1; ///< cycles from the slot that ends a row to Row Generation
        bool end_probe = true;      ///< each entry costs one more slot, which finds its end
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        SlotAccount slots;   ///< of the window; the rest of the frame is not this engine's
        ActiveWindow window; ///< first to last slot of a Row PE
        std::uint64_t tiles = 0;
        std::uint64_t splats = 0, splats_abandoned = 0, rows_skipped = 0;
        Cycle generating = 0, queue_wait = 0, input_wait = 0;
        std::uint64_t entries = 0, entries_dropped = 0, pixels = 0, pixels_ended = 0;
        std::uint64_t drain_slots = 0;
        void describe_generation(StatsVisitor& v) const {
            v.count("splats", splats, "splats", "Splats taken in, at most one per cycle.");
            v.count("splats_abandoned", splats_abandoned, "splats",
                    "Splats that came when their tile had ended.");
            v.count("rows_skipped", rows_skipped, "rows",
                    "Rows of splats not solved because all their pixels had ended.");
            v.count("queue_wait_cycles", queue_wait, "cycles",
                    "Waiting with a splat whose row queue had no room.");
            v.count("input_wait_cycles", input_wait, "cycles",
                    "Waiting for the next splat of a tile.");
        }
        void describe_row_pes(StatsVisitor& v) const { // slots are described by the result
            v.count("entries", entries, "rows", "Row entries executed.");
            v.count("entries_dropped", entries_dropped, "rows",
                    "Row entries dropped because all pixels of the row had ended.");
            v.count("pixels", pixels, "pixels", "Pixels in the intervals of executed entries.");
            v.count("pixels_ended", pixels_ended, "pixels",
                    "Pixels that ended before the end of their list.");
            v.count("drain_slots", drain_slots, "PE-cycles",
                    "Idle PE-cycles from the last splat of a tile to the tile's end.");
        }
    };

    FifoPort<SplatChunk> in;           ///< tiles in the order granted, then kNoTile
    FifoPort<TileNumber> context_free; ///< one message for each tile from tile `contexts` on
    FifoPort<SliceReport> tile_done;   ///< to the Pixel Buffer, once per tile, then kNoTile
    FifoPort<SliceReport> tile_state;  ///< to the Tile Monitor, once per tile, then kNoTile

    /// The engine's n-th tile lives in context first_context + n mod contexts of the data path.
    TileEngine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, int first_context, int contexts);

    const Stats& stats() const { return stats_; }

private:
    struct RowPe {
        Cycle free = 0;       // first cycle without work, as far as entries have been pushed
        std::size_t next = 0; // queue cell of the next entry
    };
    struct Entry { // of a row's queue; row and column inside the tile
        std::uint32_t splat = 0;
        int row = 0, column = 0, length = 0;
    };
    struct Row {
        Cycle ended = 0; // from this date on generation leaves it out; kNever while pixels live
        int live = 0;    // pixels
    };

    void end_of_elaboration() override;
    void run();
    const SplatChunk& next_chunk();
    void start_tile(TileNumber number);
    void take_context();
    void work();
    bool abandoned() const { return self_.local() >= ended_; }
    void generate(std::uint32_t splat);
    Cycle push(const Entry& entry, Cycle now);
    template <bool Recorded>
    Cycle execute(const Entry& entry, Cycle load);
    void row_ended(Row& row, Cycle slot);
    void report_tile(Cycle last_slot);
    void finish_tile();
    void account_idle();
    void prepare_record();

    Config config_;
    RenderJob& job_;
    int first_context_, contexts_;
    Process self_; // at the date at which entries are pushed
    std::vector<RowPe> pes_;
    std::vector<Cycle> loaded_; // per PE and queue cell: date at which its last entry was loaded
    std::vector<std::size_t> pe_of_row_;
    // State of the present tile.
    TileNumber number_ = kNoTile;
    const JobTile* tile_ = nullptr;
    std::vector<Row> rows_;
    int context_ = 0;
    Cycle started_ = 0;
    int live_rows_ = 0;
    Cycle last_end_ = 0;   // latest slot that ended a row
    Cycle ended_ = kNever; // from this date on generation knows that every pixel has ended
    bool reported_ = false;
    std::uint64_t blocked_ = 0;          // slots without a context since the last slot of work
    std::optional<EngineRecord> record_; // if slots or busy cycles are wanted with their dates
    Stats stats_;
};

} // namespace degs::gbu
