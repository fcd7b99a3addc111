// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include <systemc>

#include "config/config.hpp"
#include "config/statistics.hpp"
#include "modules/array/feature_buffer.hpp"
#include "modules/render_job.hpp"
#include "modules/scheduler/packing_unit.hpp"
#include "modules/scheduler/segment_queue.hpp"
#include "modules/scheduler/segmenter.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

/// The grain in which the array reports ended pixels and the bank skips them: whole segments
/// (paper, Sec. IV-B), or single pixels.
enum class TerminationGrain { Segment, Pixel };

/// One Issue Bank of the Packing Scheduler (paper, Sec. IV-B): takes the row spans of its rows in
/// depth order, cuts them at fixed strides (Segmenter), and issues segments to its Packing Unit,
/// each as soon as its conflict domain (row x segment) may be updated again. Inside a domain order
/// is kept; across domains any ready one may go. Segments of terminated regions are dropped.
///
/// In cycle t the bank takes terminations and freed contexts dated <= t, accepts segments, and issues segments.
class IssueBank : public sc_core::sc_module {
public:
    struct Config {
        int count = 8;              ///< banks
        int queue_depth = 32;       ///< segments waiting in a bank
        int segment_length = 16;    ///< px, stride of the Segmenter
        int segments_per_cycle = 2; ///< cut and accepted per cycle
        int issue_width = 2;        ///< segments issued per cycle
        int reuse_cycles = 4;       ///< between two updates of a pixel
        int feature_entries = 64;   ///< splats whose parameters the bank may need at once
        int open_splats = 1;        ///< splats whose rows may arrive in turn
        bool scoreboard = true;
        TerminationGrain termination = TerminationGrain::Segment;
        DomainScan scan = DomainScan::RoundRobin;
    };
    struct Stats {
        std::uint64_t spans = 0, tasks_in = 0;
        std::uint64_t segments_issued = 0, tasks_issued = 0;
        std::uint64_t segments_dropped = 0, tasks_dropped = 0;
        Cycle busy = 0; ///< cycles with an issue
        std::uint64_t queue_high_water = 0;
        void describe(StatsVisitor& v) const {
            v.count("tasks_in", tasks_in, "tasks", "Tasks taken in from the Span Units.");
            v.count("tasks_issued", tasks_issued, "tasks", "Tasks issued to the Packing Units.");
            v.count("tasks_dropped", tasks_dropped, "tasks",
                    "Tasks dropped because their pixel had ended.");
            v.count("segments_issued", segments_issued, "segments", "Segments issued.");
            v.count("segments_dropped", segments_dropped, "segments",
                    "Segments dropped because all their pixels had ended.");
            v.peak("queue_high_water", queue_high_water, "segments",
                   "Most segments that waited in one Issue Bank.");
        }
    };

    sc_core::sc_vector<FifoPort<SpanItem>> in; ///< one per Span Unit that reaches this bank
    FifoPort<Termination> terminated;          ///< from the array slice
    FifoPort<TileNumber> context_free;         ///< from the Pixel Buffer: tiles that may start

    /// `packing` takes what the bank issues; it must exist until the bank has finished.
    IssueBank(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
              const RenderJob& job, PackingUnit& packing, int index, std::size_t inputs,
              int contexts);

    const Stats& stats() const { return stats_; }
    const FeatureBuffer& features() const { return features_; }

private:
    static constexpr std::uint32_t kAllPixels = ~0U;
    void end_of_elaboration() override;
    void run();
    void see_terminations();
    void see_contexts();
    void end_pixels(const Termination& message);
    std::uint32_t end_pixels(SegmentQueue::Tile& tile, int domain, std::uint32_t mask) const;
    void enter_tile();
    void accept(Cycle now);
    bool open_span(Cycle now);
    bool cut_segment();
    void drop(std::uint32_t mask);
    bool issue(Cycle now);
    bool issue_one(Cycle now, SegmentQueue::Tile& tile);
    bool finish_tiles();
    Idle idle_cause() const;
    /// The first tile that may not issue, or has nothing to issue yet.
    TileNumber first_unstarted() const {
        return std::min(startable_, entering_tile_ + (entered_ ? 1U : 0U));
    }
    Cycle next_ready(Cycle now) const;
    Cycle next_date(Cycle now);

    bool takes(TileNumber tile) const { return tile == entering_tile_ && in_flight(tile); }
    bool in_flight(TileNumber tile) const {
        return tile >= oldest_tile_ && tile < oldest_tile_ + tiles_in_flight_;
    }

    Config config_;
    const RenderJob& job_;
    PackingUnit& packing_;
    int contexts_;
    int tiles_in_flight_;
    bool by_pixel_; // TerminationGrain::Pixel
    // The rings to which the ports are bound.
    std::vector<DatedFifo<SpanItem>*> inputs_;
    DatedFifo<Termination>* terminations_ = nullptr;
    DatedFifo<TileNumber>* contexts_freed_ = nullptr;
    Process self_;
    Segmenter segmenter_;
    SegmentQueue queue_;
    FeatureBuffer features_;
    TileNumber oldest_tile_ = 0; // first tile that is not over for this bank
    // Tiles below this number have a Pixel Buffer context; at most contexts_ beyond oldest_tile_.
    TileNumber startable_ = 0;
    TileNumber entering_tile_ = 0; // tile whose spans are accepted: one at a time, in order
    bool entered_ = false;         // something of entering_tile_ has been taken
    std::size_t ends_seen_ = 0;    // inputs that have delivered everything of entering_tile_
    std::uint64_t sequence_ = 0;   // segments so far
    bool no_room_ = false;         // a ready segment waits for room in the Packing Buffer
    bool width_limited_ = false;
    bool features_full_ = false;     // the next span waits for a Feature Buffer entry
    std::vector<FifoBase*> watched_; // inputs that can end the bank's sleep
    Stats stats_;
};

} // namespace degs
