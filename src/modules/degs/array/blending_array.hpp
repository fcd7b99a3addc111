// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <systemc>

#include "modules/degs/array/early_blender.hpp"
#include "modules/degs/array/task_blender.hpp"
#include "modules/degs/array/termination_grain.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/slot_recorder.hpp"
#include "modules/kit/job/tile_end.hpp"
#include "stats/statistics.hpp"

namespace degs {

/// One slice of the Blending Array: the PEs that serve one bank (paper, Sec. IV-C). It executes one
/// packet per cycle, in order. The data path computes q_n, alpha and the recurrence; without span
/// parsing the PEs also test whether their pixel is inside the ellipse. Pixel state is
/// written back after `writeback_cycles`, and the reports that a pixel or a whole segment has ended
/// leave at the same date. The slice never stalls, because a packet is issued only when nothing can
/// stop it.
class ArraySlice : public sc_core::sc_module, public LoggedBlock, private Pumped {
public:
    struct Config {
        int pes_per_bank = 8;
        int writeback_cycles = 4; ///< execution to pixel state written back (paper: 4)
        // What follows from the blocks around the slice; their own sections have the keys.
        TerminationGrain termination = TerminationGrain::Segment;
        int region_listeners = 0; ///< Slicing Units of a stream if they skip dead rows, else 0
        int streams = 1;          ///< tile streams
        int contexts = 1;         ///< tiles of a stream that the Pixel Buffer holds
        int first_context = 0;    ///< of the Pixel Buffer
        bool granted = false;     ///< tiles come one by one, see TileEnd
        bool scoreboard = true;   ///< no pixel comes again before its write-back
        bool tests = false;       ///< PEs test whether their pixel is inside the ellipse
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        SlotAccount slots; ///< executed tasks by class; idle slots are the Packing Unit's
        ActiveWindow window;
        std::uint64_t packets = 0;
        /// Pixels updated again before their write-back; must be 0 with a scoreboard.
        std::uint64_t hazards = 0;
        std::uint64_t pixels_ended = 0;
        void describe(StatsVisitor& v) const { // slots and hazards are described by the result
            v.count("packets", packets, "packets", "Packets executed, one in each busy cycle.");
            v.count("pixels_ended", pixels_ended, "pixels",
                    "Pixels that ended before the end of their list.");
        }
    };

    FifoPort<TaskPacket> in;
    FifoPort<Termination> terminated; ///< to the bank
    /// To the Slicing Units that share a row with this slice, stream by stream; empty unless they
    /// skip dead rows.
    sc_core::sc_vector<FifoPort<RegionEnded>> region_ended;
    // The slice reports once per tile, on one port per stream. Where tiles are granted one by one,
    // kNoTile ends the reports.
    sc_core::sc_vector<FifoPort<SliceReport>> tile_done;  ///< to the Pixel Buffer
    sc_core::sc_vector<FifoPort<SliceReport>> tile_state; ///< to the Tile Monitor

    ArraySlice(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, int index, int slices, int segment_length);

    const Stats& stats() const { return stats_; }
    // For tasks whose outcomes a FunctionalModel has found: the Packing Unit tells the dates at
    // which they execute, which do not fall, in place of sending packets.
    /// Tells that the tasks `mask` of a segment execute in the cycles `first` to `last`.
    inline void execute(const TaskRun& run, std::uint32_t mask, Cycle first, Cycle last);
    /// Counts tasks by class; see TaskOutcome.
    inline void count_replayed(std::uint32_t mask, std::uint32_t inside, std::uint32_t useful);
    /// Counts tasks by class that execute() has not counted.
    void count_replayed(const SlotAccount& tasks) { stats_.slots += tasks; }
    /// Tells that the pixels `ended` of a segment end at `date`.
    void end_replayed(const TaskRun& run, std::uint32_t ended, Cycle date);
    /// Tells that nothing more follows about the tasks of the cycle `date`.
    inline void pass_packet(Cycle date);
    /// Tells that a tile ends at `date`, or as soon as what came before has been executed. With
    /// `packet` it ends together with the tasks of this cycle, about which nothing more follows.
    void pass_end(TileNumber tile, std::int16_t context, Cycle date, bool packet);

    /// Records executed tasks in `part`, which may be null; before the simulation starts.
    void record(SlotPart* part) { part_ = part; }
    /// Expects packets that are replayed: they carry dates, and of their tasks only those that end
    /// a pixel. Before the simulation starts.
    void expect_replay() { replays_ = true; }
    /// Logs packets taken, ended pixels and regions reported, and tiles handed over.
    void log_to(EventLog& log) override { log_ = &log; }

private:
    /// What to do with the tasks of packets: blend them, record them as well, or neither, since a
    /// FunctionalModel has blended them and the Packing Unit has recorded them.
    enum class Tasks { Blended, Recorded, Replayed };
    /// Takes the packets of a slice whose tasks are not only blended, so that the slice's own
    /// pump(), which is the common one, need not ask.
    class RecordedPump : public Pumped {
    public:
        explicit RecordedPump(ArraySlice& slice) : slice_(slice) {}
        void pump() override;

    private:
        ArraySlice& slice_;
    };
    struct Recent {
        Cycle date = 0;
        std::uint32_t mask = 0;
    };
    /// The state of a tile in this slice: which of its pixels are still alive.
    struct Context {
        TileNumber tile = kNoTile;
        int live_pixels = 0;
        bool reported = false;
        std::vector<int> live_in_segment;
        std::vector<std::uint32_t> ended_in_segment;
        std::vector<Recent> recent; ///< per segment: pixels updated lately
    };
    void end_of_elaboration() override;
    void start_of_simulation() override;
    void run();
    void pump() override;
    /// The context of the tile. If the tile is new to it, the context is prepared first.
    Context& context_of(std::int16_t context, TileNumber tile) {
        if (current_->tile != tile) {
            current_ = &contexts_[context - config_.first_context];
            if (current_->tile != tile) {
                start_tile(*current_, tile);
            }
        }
        return *current_;
    }
    [[gnu::noinline]] void start_tile(Context& context, TileNumber number);
    template <Tasks Kind>
    void execute(const TaskPacket& packet);
    template <Tasks Kind>
    void pump_packets();
    void end_pixels(const TaskPacket& packet);
    /// The tasks of `run` that are in this packet, from the outcome of its segment.
    void record(const TaskRun& run, Cycle date);
    // What is rare stays out of the loop over packets, which then keeps more in registers.
    [[noreturn, gnu::noinline]] void refuse(Cycle slot) const;
    [[gnu::noinline]] BlendOutcome blend_otherwise(const Context& context, const TaskRun& run,
                                                   Cycle date);
    BlendOutcome blend_early(const Context& context, const TaskRun& run, Cycle date);
    inline void check_reuse(Recent& recent, std::uint32_t tasks, Cycle date);
    [[gnu::noinline]] void pixels_ended(Context& context, const TaskRun& run, std::uint32_t ended);
    void report_region(const Context& context, const TaskRun& run);
    [[gnu::noinline]] void end_tile(TileNumber number, std::int16_t context);
    void end_reports();
    void count_tile(TileNumber number);
    std::size_t stream_of(std::int16_t context) const {
        return (context - config_.first_context) / config_.contexts;
    }

    Config config_;
    RenderJob& job_;
    int index_, slices_, segment_length_, segments_per_row_;
    Process self_;
    DatedFifo<TaskPacket>* packets_ = nullptr; // the ring behind `in`
    std::vector<Context> contexts_;            // contexts in use have taken host memory
    Context* current_;                         // asked for last
    int segments_;                             // of a context
    std::vector<std::size_t> port_of_row_; // in region_ended, of a stream; empty without listeners
    BlendOutcome outcome_; // of the segment whose tasks execute, or of the part without scoreboard
    bool plain_;           // solved tasks and a scoreboard: asked once per segment, so in one place
    TaskBlender blender_;
    std::optional<EarlyBlender> early_; // without scoreboard
    TileEnd tiles_;
    SlotPart* part_ = nullptr;
    bool replays_ = false;
    RecordedPump recorded_{*this};
    Stats stats_;
    EventLog* log_ = nullptr;
};

inline __attribute__((always_inline)) void
ArraySlice::execute(const TaskRun& run, std::uint32_t mask, Cycle first, Cycle last) {
    Context& context = context_of(run.task.context, run.tile);
    Recent& recent = context.recent[run.domain];
    check_reuse(recent, mask, first);
    recent.date = last;
    count_replayed(mask, run.outcome.inside, run.outcome.useful);
}

inline __attribute__((always_inline)) void
ArraySlice::count_replayed(std::uint32_t mask, std::uint32_t inside, std::uint32_t useful) {
    const auto count = [](std::uint32_t bits) {
        return static_cast<std::uint64_t>(__builtin_popcount(bits));
    };
    const std::uint64_t all_inside = count(mask & inside);
    const std::uint64_t all_useful = count(mask & useful);
    stats_.slots[Slot::Useful] += all_useful;
    stats_.slots[Slot::Boundary] += count(mask) - all_inside;
    stats_.slots[Slot::Terminated] += all_inside - all_useful;
}

inline __attribute__((always_inline)) void ArraySlice::pass_packet(Cycle date) {
    if (self_.local() > date) {
        refuse(date);
    }
    if (stats_.packets++ == 0) {
        stats_.window.include(date);
    }
    stats_.window.last = date;
    self_.advance_to(date + 1);
}

// The scoreboard exists for this invariant. One date per segment is enough for it: a pixel that
// came before that date may count too much, but no hazard is missed. EarlyBlender counts exactly.
inline void ArraySlice::check_reuse(Recent& recent, std::uint32_t tasks, Cycle date) {
    const Cycle writeback = config_.writeback_cycles;
    const bool late = date - recent.date >= writeback;
    const std::uint32_t busy = late ? 0 : recent.mask;
    if ((busy & tasks) != 0) { // never with a scoreboard
        stats_.hazards += __builtin_popcount(busy & tasks);
    }
    recent.mask = busy | tasks;
    recent.date = date;
}

} // namespace degs
