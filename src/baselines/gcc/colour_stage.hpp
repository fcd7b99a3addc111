// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "baselines/gcc/block_mask.hpp"
#include "baselines/gcc/messages.hpp"
#include "baselines/gcc/traffic.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs::gcc {

/// Stage III of GCC. It reads SH for those Gaussians of a projected group that can still
/// contribute, computes their colours, and sorts them exactly. A Gaussian cannot contribute if all
/// blocks of the view that its bounding box meets have ended; the mask is looked at once per group,
/// when the group enters. Colours and sorting overlap; a group is handed to Stage IV when both are
/// done. Groups of a view whose pixels have all ended are dropped.
class ColourStage : public sc_core::sc_module {
public:
    struct Config {
        int units = 4;             ///< SH units
        int cycles_per_colour = 1; ///< initiation interval of a unit
        int keys_per_cycle = 4;    ///< sorter, per pass
        int merge_ways = 16;       ///< fan-in of a pass: n keys take ceil(log_ways n) passes
        bool skip_ended = true;    ///< the mask; false: all projected Gaussians are coloured
        int block = 8;             ///< px, granularity of the mask
        int feedback_cycles = 8;   ///< from the array to the mask
        int chunk = 16;            ///< splats per hand-over to Stage IV
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle colour_busy = 0, sort_busy = 0;
        std::uint64_t coloured = 0, masked = 0, cancelled = 0;
        void describe(StatsVisitor& v) const {
            v.count("coloured", coloured, "Gaussians", "Gaussians coloured and sorted.");
            v.count("masked", masked, "Gaussians",
                    "Gaussians dropped because every block they can reach had ended.");
            v.count("cancelled", cancelled, "Gaussians",
                    "Gaussians dropped because their view had ended.");
        }
    };

    FifoPort<SplatChunk> in;                              ///< groups
    FifoPort<TileNumber> cancel;                          ///< from the Tile Monitor
    sc_core::sc_vector<FifoPort<BlockEnded>> block_ended; ///< if the mask is used
    FifoPort<SplatChunk> out;                             ///< to Stage IV
    MemoryPort sh;

    /// `groups_ahead`: groups whose SH is on its way while another is coloured. `granted`: groups
    /// end with kNoTile, which is handed on; else those of all views of the job come.
    ColourStage(const sc_core::sc_module_name& name, const Config& config, const Traffic& traffic,
                const Timebase& time, const RenderJob& job, int groups_ahead, bool granted = false);

    const Stats& stats() const { return stats_; }
    /// Cycles in which SH, but the first, were awaited.
    Cycle memory_wait() const { return fetched_.stats().late_cycles; }

private:
    /// Gaussians of a group that are left, as runs of neighbours in the view's list.
    struct Survivors {
        SplatChunk group;
        std::uint64_t count = 0;
        std::vector<SplatChunk> runs;
    };
    void end_of_elaboration() override;
    void fetch();
    void see_ended_blocks(TileNumber view);
    Survivors filter(const SplatChunk& group);
    Completion read_sh(const Survivors& survivors);
    void shade();
    Cycle sort_cycles(std::uint64_t keys) const;
    void hand_over(const Survivors& survivors);

    Config config_;
    Traffic traffic_;
    const RenderJob& job_;
    bool granted_;
    Process fetcher_, shader_;
    DatedFifo<Survivors> fetched_;
    std::vector<std::uint32_t> gaussians_; // whose SH are read
    BlockMask mask_;
    TileNumber masked_view_ = kNoTile; // whose blocks the mask shows
    TileNumber from_ = 0;              // earlier views are cancelled or over
    Cycle shade_cycles_ = 0;           // in which colours or keys were worked on
    Stats stats_;
};

} // namespace degs::gcc
