// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <vector>

#include <systemc>

#include "config/config.hpp"
#include "modules/degs/array/feature_buffer.hpp"
#include "modules/degs/array/termination_grain.hpp"
#include "modules/degs/scheduler/bank_stream.hpp"
#include "modules/degs/scheduler/issue_trace.hpp"
#include "modules/degs/scheduler/packing_unit.hpp"
#include "modules/degs/scheduler/pick_pipeline.hpp"
#include "modules/degs/scheduler/segment_queue.hpp"
#include "modules/degs/scheduler/segmenter.hpp"
#include "modules/degs/span_engine/span_unit.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/tile_end.hpp"
#include "stats/statistics.hpp"

namespace degs {

class DrawnBank;

/// One Issue Bank of the Packing Scheduler (paper, Sec. IV-B): takes the row spans of its rows in
/// depth order, cuts them at fixed strides (Segmenter), and issues segments to its Packing Unit,
/// each as soon as its conflict domain (row x segment) may be updated again. Inside a domain order
/// is kept; across domains any ready one may go. Segments of terminated regions are dropped.
///
/// In cycle t the bank takes terminations and freed contexts dated <= t, accepts segments, and
/// issues segments. Tiles come in one stream, or in several at once: spans are then taken from the
/// streams in turn, a tile enters when it has its context of the Pixel Buffer, and the scan rule
/// also chooses among the streams.
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
        /// A segment of these tasks is dropped.
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

    /// The only Span Units that reach the bank; before the simulation starts.
    void read_from(SpanStage& spans) { spans_ = &spans; }
    /// Writes what is issued into `trace`; before the simulation starts.
    void trace_to(IssueTrace& trace) { trace_ = &trace; }
    /// Spans and ends of tiles taken, ended pixels and contexts seen, segments issued, packets.
    void log_to(EventLog& log) override { log_ = &log; }
    const Stats& stats() const { return stats_; }
    const FeatureBuffer& features() const { return features_; }

private:
    static constexpr std::uint32_t kAllPixels = ~0U;

    void end_of_elaboration() override;
    void start_of_simulation() override;
    void start_log();
    void log_tile(std::size_t event, TileNumber number, std::initializer_list<int> more) const;
    void run();
    /// `single`: one tile stream from one Span Unit, whose loop asks for no others.
    template <bool single>
    void run_cycles();
    void see_terminations();
    void see_contexts();
    // What is rare stays out of the loop over cycles, which then keeps more in registers.
    [[gnu::noinline]] void list_started();
    [[gnu::noinline]] void end_pixels(const Termination& message);
    std::uint32_t end_pixels(SegmentQueue::Tile& tile, int domain, std::uint32_t mask) const;

    // Intake.
    enum class Taken { Nothing, End, Span };
    template <bool single>
    void accept(Cycle now);
    template <bool single>
    bool open_span(Cycle now);
    template <bool single>
    Taken take_from(BankStream& stream, Cycle now);
    template <bool single>
    BankStream::Input* earliest_input(BankStream& stream);
    [[gnu::noinline]] void enter_tile(BankStream& stream, TileNumber number);
    [[gnu::noinline]] void take_end(BankStream& stream, TileNumber number, Cycle now);
    bool cut_segment();
    /// True if another segment of the span can be cut or dropped at once.
    bool can_cut() const;
    static bool takes(const BankStream& stream, const BankStream::Input& input) {
        return input.turn == stream.entering && stream.enterable;
    }
    std::size_t end_of_intake(const BankStream& stream) const {
        return stream_count_ == 1 ? stream.oldest + tiles_in_flight_ : stream.startable;
    }

    // Issue.
    bool issue(Cycle now);
    int issue_segments(Cycle now);
    [[gnu::noinline]] int issue_chosen(Cycle now);
    [[gnu::noinline]] void choose(Cycle now);
    BankStream* choose_stream(Cycle slot);
    bool find_ready(BankStream& stream, Cycle slot);
    BankStream* first_ready(Cycle slot);
    BankStream* least_ready(Cycle slot);
    bool issue_one(Cycle now, SegmentQueue::Tile& tile, int domain);
    bool finish_tiles();
    [[gnu::noinline]] void finish_tiles(BankStream& stream);

    bool over() const { return tiles_.over() && closing_ == 0; }

    // Dates.
    Slot idle_cause() const;
    Cycle next_ready(Cycle now) const;
    Cycle next_date(Cycle now);
    bool watch_inputs(Cycle now);

    SegmentQueue::Tile& tile_at(const BankStream& stream, std::size_t turn) {
        return queue_.tile(turn, stream.index);
    }

    Config config_;
    const RenderJob& job_;
    int index_;
    PackingUnit& packing_;
    int contexts_;        // of a stream
    int tiles_in_flight_; // of a single stream
    bool by_task_;        // TerminationGrain::Task
    bool sees_pixels_;    // not TerminationGrain::Segment
    bool fills_;          // filling a Feature Buffer entry takes time
    std::vector<BankStream> streams_;
    std::size_t stream_count_;                 // theirs, at hand in the hot loop
    int spans_per_cycle_;                      // that the crossbar delivers
    bool contexts_owed_ = false;               // a stream has fewer contexts than it may have
    std::vector<SegmentQueue::Tile*> started_; // that may issue: stream by stream, oldest first
    std::size_t closing_ = 0;                  // tiles of which nothing more will be taken
    DatedFifo<Termination>* terminations_ = nullptr; // the ring behind `terminated`
    Process self_;
    Segmenter segmenter_;
    SegmentQueue queue_;
    PickPipeline pipeline_;
    FeatureBuffer features_;
    SegmentQueue::Tile* cut_tile_ = nullptr; // of the span that is cut
    BankStream* next_stream_;                // whose span is taken next
    int spans_left_ = 0;                     // that may be taken in this cycle
    BankStream* issued_stream_;              // that issued last
    TileEnd tiles_;
    std::uint64_t sequence_ = 0; // segments so far
    bool no_room_ = false;       // a ready segment waits for room in the Packing Buffer
    bool width_limited_ = false;
    Slot width_cause_;               // what limits the width
    bool features_full_ = false;     // a span waits for a Feature Buffer entry
    std::vector<FifoBase*> watched_; // inputs that can end the bank's sleep
    Stats stats_;
    IssueTrace* trace_ = nullptr;
    IssueTrace logged_issues_;
    EventLog* log_ = nullptr;
    std::size_t tile_event_ = 0, over_event_ = 0;
    SpanStage* spans_ = nullptr;
    std::unique_ptr<DrawnBank> drawn_bank_; // what runs in its place, if anything does
};

} // namespace degs
