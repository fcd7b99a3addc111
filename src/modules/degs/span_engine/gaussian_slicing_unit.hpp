// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "config/config.hpp"
#include "modules/degs/functional/functional_model.hpp"
#include "modules/degs/span_engine/open_chunks.hpp"
#include "modules/degs/span_engine/span_replay.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/sram_ports.hpp"
#include "stats/statistics.hpp"

namespace degs {

/// What the units share. `Broadcast`: every unit sees every splat, spends a cycle on it at least
/// and takes the rows whose index is its own modulo the number of units. `BroadcastSkip`: the same,
/// but a splat without a row of the unit costs it nothing. `Splats`: every splat goes to one unit,
/// which takes all of its rows.
enum class SliceDistribution { Broadcast, BroadcastSkip, Splats };

/// Enumerates the scanlines of each splat inside the tile and pushes them into the Span Buffer
/// (paper, Sec. IV-A). The module is one unit, or all units if they share out the splats, because
/// they then fill the lanes together. Splats that cover a pixel must reach it in depth order. Units
/// that own rows keep this order by themselves. Units that own splats never overtake an older
/// splat: they send a row only when every older splat in work has passed that row, in the same
/// cycle at the earliest [assumed]. A full lane of the Span Buffer stops all units of the module.
///
/// With several tile streams every stream has units of its own, which share its tiles in the same
/// way. Where tiles are granted one by one, kNoTile ends every lane.
///
/// Drops the splats of a cancelled tile, a chunk per cycle. With skip_dead_rows (not in the paper)
/// the array also reports rows whose pixels have all ended; they are masked out, sampled once per
/// chunk.
class GaussianSlicingUnit : public sc_core::sc_module, public LoggedBlock {
public:
    struct Config {
        int count = 2;            ///< units
        int interleave = 1;       ///< tile streams, each with as many of the units
        int rows_per_cycle = 8;   ///< scanlines emitted per unit and cycle
        int splats_per_cycle = 1; ///< splats that a unit takes per cycle at most
        SliceDistribution distribution = SliceDistribution::Splats;
        SlicedRows rows = SlicedRows::Splat;
        bool skip_dead_rows = false; ///< leave out rows whose pixels have all ended
        int feedback_cycles = 8;     ///< from the last pixel's end to the units that skip its row
        // Ports of the buffers at both ends; the sections of these buffers have the keys.
        BankedSramPorts splat_ports; ///< of a module's part of the Gaussian Buffer
        SramPorts row_ports;         ///< of a lane of the Span Buffer
        bool reports_chunks = false; ///< to Parameter Release
        bool granted = false;        ///< tiles come one by one, see TileEnd
        void describe(ConfigVisitor& visitor);
        /// Modules of a stream, among which the rows are dealt; each has units_per_module() units.
        int modules() const {
            return distribution == SliceDistribution::Splats ? 1 : count / interleave;
        }
        int units_per_module() const { return count / interleave / modules(); }
    };
    struct Stats {
        Cycle busy = 0;
        std::uint64_t splats = 0, rows = 0, rows_skipped = 0, splats_cancelled = 0;
        std::uint64_t splat_port_waits = 0, row_port_waits = 0;
        void describe(StatsVisitor& v) const {
            v.count("splats", splats, "splats", "Splats taken in, by every unit that reads them.");
            v.count("splats_cancelled", splats_cancelled, "splats",
                    "Splats dropped because their tile was finished.");
            v.count("rows", rows, "rows", "Rows of splats sent to the Span Units.");
            v.count("rows_skipped", rows_skipped, "rows",
                    "Rows not sent because all their pixels had ended (skip_dead_rows).");
            v.count(
                "splat_port_waits", splat_port_waits, "cycles",
                "Units that could not read their next splat: gaussian_buffer.ports were taken.");
            v.count("row_port_waits", row_port_waits, "cycles",
                    "Units that could not write their next row: span_buffer.ports were taken.");
        }
    };

    /// Gaussian Buffer: one per Sorting Unit, tile t from port t modulo their number; or that of
    /// the stream, whose tiles come one after another until kNoTile.
    sc_core::sc_vector<FifoPort<SplatChunk>> in;
    FifoPort<TileNumber> cancel;               ///< from the Tile Monitor
    sc_core::sc_vector<FifoPort<RowItem>> out; ///< Span Buffer lanes of this unit's rows
    /// From the array slices that share a row with this unit; empty unless skip_dead_rows.
    sc_core::sc_vector<FifoPort<RegionEnded>> region_ended;

    /// To Parameter Release, see there; empty unless parameters live until the spans are made.
    sc_core::sc_vector<FifoPort<ChunkSliced>> sliced;
    sc_core::sc_vector<FifoPort<RowCount>> row_counts;

    /// Module `index` of a stream with `lanes` lanes feeds lanes index, index + modules(), ... Row
    /// y goes to lane y modulo the lanes.
    GaussianSlicingUnit(const sc_core::sc_module_name& name, const Config& config,
                        const Timebase& time, const RenderJob& job, int index, std::size_t inputs,
                        int lanes, std::size_t slices, int segment_length);

    const Stats& stats() const { return stats_; }
    /// The Span Units that read output `lane`, if known; before the simulation starts.
    void write_to(std::size_t lane, const SpanStage& spans) { readers_[lane] = &spans; }
    /// Takes the rows of every splat and their outcomes from `model`; before the simulation starts.
    void replay(FunctionalModel& model) { functional_ = &model; }
    /// Logs chunks of splats, cancelled tiles and ended regions taken, rows and ends of tiles sent.
    void log_to(EventLog& log) override { log_ = &log; }

private:
    /// A splat that a unit works on.
    struct Slice {
        std::uint32_t splat = 0;
        int row = 0, last = -1;              // the next row to send, and the last one
        std::uint64_t below = 0;             // a bit per segment that its box covers
        int rows_left = 0;                   // that the unit may send in this cycle
        int splats_left = 0;                 // that it may take in this cycle, this one included
        std::uint64_t chunk = 0;             // see OpenChunks
        std::size_t row_buffer = 0;          // its place in row_buffers_
        const RowOutcome* outcome = nullptr; // of `row`
        bool done() const { return row > last; }
    };

    void end_of_elaboration() override;
    void start_of_simulation() override;
    void run();
    TileNumber tile_after(TileNumber number);
    void slice_tile(TileNumber number);
    void end_lanes(TileNumber number);
    bool more_splats(TileNumber number);
    void deal(TileNumber number);
    void work(TileNumber number);
    bool cancelled(TileNumber number);
    [[gnu::noinline]] void see_ended_regions(TileNumber number);
    void expect_splats() const;
    bool add_slice(TileNumber number);
    void begin(TileNumber number, Slice& slice);
    void take_outcomes(TileNumber number, std::uint32_t place, Slice& slice);
    [[gnu::noinline]] std::uint64_t segments_below(const JobTile& tile, std::uint32_t splat) const;
    void send_rows(TileNumber number, Slice& slice, int before);
    inline void put_row(TileNumber number, const Slice& slice, DatedFifo<RowItem>& lane);
    bool takes_row_port(std::size_t lane);

    Config config_;
    const RenderJob& job_;
    int index_, modules_; // of a stream
    int segment_length_;
    Process self_;
    TileNumber cancelled_before_ = 0;
    std::vector<std::size_t> lane_of_row_;   // output port by row inside the tile
    std::vector<DatedFifo<RowItem>*> lanes_; // what the ports are bound to
    std::vector<const SpanStage*> readers_;
    std::vector<SpanReplay*> replay_lanes_; // by lane: takes its rows in its place; may be null
    struct Writes {
        Cycle date = 0;
        int count = 0;
    };
    std::vector<Writes> row_writes_;   // by lane: those of the latest cycle
    int splat_reads_left_ = 0;         // in this cycle
    std::vector<std::uint64_t> ended_; // per row of the tile being sliced: a bit per segment
    SplatChunk chunk_;                 // the one being dealt
    std::uint32_t dealt_ = 0;          // splats of it
    bool dropping_ = false;            // a chunk in this cycle
    std::vector<Slice> slices_;        // in work, oldest first
    OpenChunks open_chunks_;
    FunctionalModel* functional_ = nullptr;
    std::vector<std::vector<RowOutcome>> row_buffers_; // outcomes of the splats in work
    std::vector<std::size_t> free_row_buffers_;
    Stats stats_;
    EventLog* log_ = nullptr;
};

} // namespace degs
