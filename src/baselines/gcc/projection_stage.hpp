// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include <systemc>

#include "baselines/gcc/traffic.hpp"
#include "modules/kit/front_end/projection_rate.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs::gcc {

/// Stage II of GCC. It takes the views in order and the groups of a view near to far. It reads the
/// list of a group, then scale, rotation and opacity of its Gaussians, and projects them. A group
/// is a fixed number of neighbours in the view's list; the last one may be smaller. Three
/// overlapping steps, each some groups ahead of the next. Once all pixels of a view have ended, its
/// further groups are not read. A Gaussian is read again for every view that it overlaps. Either
/// the stage works on all views of the job, or views are granted to it one by one, ascending.
class ProjectionStage : public sc_core::sc_module {
public:
    struct Config : ProjectionRate {
        int units = 4;           ///< projection units
        int group = 256;         ///< Gaussians per group
        int groups_ahead = 1;    ///< between two steps
        int latency_cycles = 32; ///< projection pipeline
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle busy = 0;
        std::uint64_t groups = 0, entries = 0, entries_cancelled = 0;
        std::uint64_t shapes = 0, shapes_cancelled = 0; ///< Gaussians
        void describe(StatsVisitor& v) const {
            v.count("groups", groups, "groups", "Lists of groups read.");
            v.count("entries", entries, "entries", "Entries of these lists.");
            v.count("entries_cancelled", entries_cancelled, "entries",
                    "Entries not read because their view had ended.");
            v.count("gaussians", shapes, "Gaussians", "Gaussians read and projected.");
            v.count("gaussians_cancelled", shapes_cancelled, "Gaussians",
                    "Entries read whose Gaussian was not, because their view had ended.");
        }
    };

    FifoPort<std::uint32_t> start;                   ///< frames whose lists are complete
    sc_core::sc_vector<FifoPort<TileNumber>> cancel; ///< from the Tile Monitor, one per reader
    FifoPort<SplatChunk> out;                        ///< groups; the last one may be empty
    /// To the Tile Dispatcher, for another view, and its answers, until kNoTile, which ends the
    /// groups, too. Both are empty unless views are granted.
    sc_core::sc_vector<FifoPort<TileRequest>> request;
    sc_core::sc_vector<FifoPort<SortedRun>> views;
    MemoryPort lists;
    MemoryPort shapes;

    ProjectionStage(const sc_core::sc_module_name& name, const Config& config,
                    const Traffic& traffic, const Timebase& time, const RenderJob& job,
                    bool granted = false);

    const Stats& stats() const { return stats_; }
    /// Cycles in which the step that waited longer did so for lists or shapes, but the first ones.
    Cycle memory_wait() const {
        return std::max(loaded_.stats().late_cycles, fetched_.stats().late_cycles);
    }

private:
    void end_of_elaboration() override;
    TileNumber next_view();
    void load();
    void load_view(TileNumber number);
    void fetch();
    Completion read_shapes(const SplatChunk& group);
    void project();

    Config config_;
    Traffic traffic_;
    const RenderJob& job_;
    bool granted_;
    Process loader_, fetcher_, projector_;
    DatedFifo<SplatChunk> loaded_, fetched_;
    std::vector<std::uint32_t> gaussians_;      // of the group that is read
    TileNumber next_view_ = 0;                  // of the job
    TileNumber load_from_ = 0, fetch_from_ = 0; // earlier views are cancelled or over
    Stats stats_;
};

/// Appends the Gaussians of a part of a view's list.
void append_gaussians(const FrameWorkload& frame, const SplatChunk& entries,
                      std::vector<std::uint32_t>& gaussians);

/// Takes the messages that have arrived on `cancel`. True if `view` is cancelled; `first` is the
/// first view that is not known to be cancelled or over. The check takes a cycle.
bool gcc_cancelled(Process& self, FifoPort<TileNumber>& cancel, TileNumber& first, TileNumber view);

} // namespace degs::gcc
