// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include <systemc>

#include "config/config.hpp"
#include "modules/degs/array/feature_buffer.hpp"
#include "modules/degs/array/termination_grain.hpp"
#include "modules/degs/scheduler/bank_log.hpp"
#include "modules/degs/scheduler/bank_stream.hpp"
#include "modules/degs/scheduler/issue_trace.hpp"
#include "modules/degs/scheduler/packing_unit.hpp"
#include "modules/degs/scheduler/segmenter.hpp"
#include "modules/degs/span_engine/span_unit.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/tile_end.hpp"
#include "stats/statistics.hpp"

namespace degs {

class BankCycles;

/// Which ready conflict domain issues first. `RoundRobin`: the next one after the last
/// that issued. `Oldest`: the one whose head segment arrived first. `Deepest`: the one
/// with most segments waiting.
enum class DomainScan { RoundRobin, Oldest, Deepest };

/// One Issue Bank of the Packing Scheduler (paper, Sec. IV-B): takes the row spans of its rows in
/// depth order, cuts them at fixed strides (Segmenter), and issues segments to its Packing Unit,
/// each as soon as its conflict domain (row x segment) may be updated again. Inside a domain order
/// is kept; across domains any ready one may go. Segments of terminated regions are dropped.
///
/// Tiles come in one stream, or in several at once: spans are then taken from the streams in turn,
/// a tile enters when it has its context of the Pixel Buffer, and the scan rule also chooses among
/// the streams. BankCycles says what happens in a cycle.
class IssueBank : public sc_core::sc_module, public LoggedBlock {
public:
    struct Config {
        static constexpr int kMostSegmentsPerPe = 256;
        int banks = 8;
        int queue_segments_per_pe = 4; ///< 0: as many as fit the Packing Buffer beside the lead
        int segment_bytes = 12;
        int segment_length = 16;    ///< px, stride of the Segmenter
        int segments_per_cycle = 2; ///< cut and accepted per cycle
        int issue_width = 2;        ///< segments issued per cycle
        int select_cycles = 0;      ///< from the choice of segments to their packing
        int reuse_cycles = 4;       ///< between two updates of a pixel
        int tiles =
            0; ///< of a stream whose segments may wait; 0: at least 2, and those with a context
        bool scoreboard = true; ///< reuse_cycles are kept
        TerminationGrain termination = TerminationGrain::Segment;
        DomainScan scan = DomainScan::RoundRobin;
        // What follows from the blocks around the bank; their own sections have the keys.
        int queue_depth = 32;     ///< segments waiting in a bank
        int spans_per_cycle = 0;  ///< taken from the crossbar; 0: as many as can be cut
        int feature_entries = 64; ///< splats whose parameters the bank may need at once
        int open_splats = 1;      ///< splats of a stream whose rows may arrive in turn
        int streams = 1;          ///< tile streams
        bool granted = false;     ///< tiles come one by one, see TileEnd
        int first_context = 0;    ///< of the Pixel Buffer
        /// Ports of the waiting segments in a bank's part of the Packing Buffer. Packets lie in a
        /// memory of their own [assumed], see PackingUnit::Config::packets_per_cycle.
        SramPorts segment_ports;
        FeatureBuffer::Fill fill;
        /// Tiles of a stream that the bank works on, if the Pixel Buffer has `contexts` of them: a
        /// queue may hold segments of the next tile while its context is still taken.
        int tiles_of(int contexts) const { return tiles == 0 ? std::max(2, contexts) : tiles; }
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        std::uint64_t spans = 0, tasks_in = 0;
        std::uint64_t segments_issued = 0, tasks_issued = 0;
        std::uint64_t segments_dropped = 0, tasks_dropped = 0;
        Cycle busy = 0; ///< cycles with an issue
        std::uint64_t queue_high_water = 0;
        /// Counts a segment of these tasks as dropped.
        void drop(std::uint32_t mask) {
            segments_dropped++;
            tasks_dropped += __builtin_popcount(mask);
        }
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

    /// One per Span Unit that reaches this bank, for the first stream, for the next one, ...
    sc_core::sc_vector<FifoPort<SpanItem>> in;
    FifoPort<Termination> terminated; ///< from the array slice
    /// From the Pixel Buffer, one per stream: another tile may start.
    sc_core::sc_vector<FifoPort<TileNumber>> context_free;

    /// `packing` takes what the bank issues; it must exist until the bank has finished. `inputs`
    /// and `contexts` are those of a stream; stream s has the contexts from first_context + s *
    /// contexts on.
    IssueBank(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
              const RenderJob& job, PackingUnit& packing, int index, std::size_t inputs,
              int contexts);
    ~IssueBank() override;

    /// Tells the only Span Units that reach the bank; before the simulation starts.
    void read_from(SpanStage& spans) { spans_ = &spans; }
    /// Writes what is issued into `trace`; before the simulation starts.
    void trace_to(IssueTrace& trace) { trace_ = &trace; }
    /// Logs spans and ends of tiles taken, ended pixels and contexts seen, segments issued,
    /// packets.
    void log_to(EventLog& log) override { log_ = &log; }
    /// Brings stats() and the slots of the array slice up to now; the end of the job does, too.
    void count_totals();
    const Stats& stats() const { return stats_; }
    const FeatureBuffer& features() const { return features_; }

private:
    void end_of_elaboration() override;
    void start_of_simulation() override;
    void start_log();
    void run();

    Config config_;
    const RenderJob& job_;
    int index_;
    PackingUnit& packing_;
    int contexts_; // of a stream
    std::vector<BankStream> streams_;
    int spans_per_cycle_;                            // that the crossbar delivers
    DatedFifo<Termination>* terminations_ = nullptr; // the ring behind `terminated`
    Process self_;
    Segmenter segmenter_;
    FeatureBuffer features_;
    TileEnd tiles_;
    Slot width_cause_; // what limits the width
    Stats stats_;
    IssueTrace* trace_ = nullptr;
    IssueTrace logged_issues_;
    EventLog* log_ = nullptr;
    std::optional<BankLog> tile_log_;
    SpanStage* spans_ = nullptr;
    std::unique_ptr<BankCycles> cycles_;
};

} // namespace degs
