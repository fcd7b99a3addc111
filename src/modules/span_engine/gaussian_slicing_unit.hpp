// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "config/config.hpp"
#include "config/statistics.hpp"
#include "modules/render_job.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

/// The scanlines into which a splat is cut: all that its ellipse meets, or those that it meets
/// inside the tile's columns.
enum class SlicedRows { Splat, Tile };

/// Enumerates the scanlines of each splat inside the tile and pushes them into the Span Buffer
/// (paper, Sec. IV-A). With several units every unit sees every splat and takes the rows whose
/// index is its own modulo the number of units, which keeps depth order per row without a merge
/// [assumed]. Drops the splats of a cancelled tile, a chunk per cycle. With skip_dead_rows (not in
/// the paper) the array also reports rows whose pixels have all ended; they are masked out, sampled
/// once per chunk.
class GaussianSlicingUnit : public sc_core::sc_module {
public:
    struct Config {
        int count = 2;          ///< units
        int rows_per_cycle = 8; ///< scanlines emitted per unit and cycle
        SlicedRows rows = SlicedRows::Splat;
        bool skip_dead_rows = false; ///< leave out rows whose pixels have all ended
        int feedback_cycles = 8;     ///< from the last pixel's end to the units that skip its row
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle busy = 0;
        std::uint64_t splats = 0, rows = 0, rows_skipped = 0, splats_cancelled = 0;
        void describe(StatsVisitor& v) const {
            v.count("splats", splats, "splats", "Splats taken in, by every unit that reads them.");
            v.count("splats_cancelled", splats_cancelled, "splats",
                    "Splats dropped because their tile was finished.");
            v.count("rows", rows, "rows", "Rows of splats sent to the Span Units.");
            v.count("rows_skipped", rows_skipped, "rows",
                    "Rows not sent because all their pixels had ended (skip_dead_rows).");
        }
    };

    sc_core::sc_vector<FifoPort<SplatChunk>> in; ///< Gaussian Buffer, one per Sorting Unit
    FifoPort<TileNumber> cancel;                 ///< from the Tile Monitor
    sc_core::sc_vector<FifoPort<RowItem>> out;   ///< Span Buffer lanes of this unit's rows
    /// From the array slices that share a row with this unit; empty unless skip_dead_rows.
    sc_core::sc_vector<FifoPort<RegionEnded>> region_ended;

    /// `lanes`: Span Units in all; this unit feeds lanes index, index + count, ...
    GaussianSlicingUnit(const sc_core::sc_module_name& name, const Config& config,
                        const Timebase& time, const RenderJob& job, int index, std::size_t inputs,
                        int lanes, std::size_t slices, int segment_length);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void run();
    bool cancelled(TileNumber number);
    void see_ended_regions(TileNumber number);
    void slice(const SplatChunk& chunk);
    std::uint64_t segments_below(const JobTile& tile, std::uint32_t splat) const;
    void slice_splat(TileNumber number, std::uint32_t splat);

    Config config_;
    const RenderJob& job_;
    int index_;
    int segment_length_;
    Process self_;
    TileNumber cancelled_before_ = 0;
    std::vector<std::size_t> lane_of_row_;   // output port by row inside the tile
    std::vector<DatedFifo<RowItem>*> lanes_; // what the ports are bound to
    std::vector<std::uint64_t> ended_;       // per row of the tile being sliced: a bit per segment
    Stats stats_;
};

} // namespace degs
