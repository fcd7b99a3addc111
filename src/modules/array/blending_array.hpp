// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <systemc>

#include "config/statistics.hpp"
#include "modules/array/early_blender.hpp"
#include "modules/array/slot_recorder.hpp"
#include "modules/array/task_blender.hpp"
#include "modules/render_job.hpp"
#include "modules/scheduler/issue_bank.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

/// One slice of the Blending Array: the PEs that serve one bank (paper, Sec. IV-C). It executes one
/// packet per cycle, in order. The data path computes q_n, alpha and the recurrence; without span
/// parsing the PEs also test whether their pixel is inside the ellipse. Pixel state is
/// written back after `writeback_cycles`, and the reports that a pixel or a whole segment has ended
/// leave at the same date. The slice never stalls, because a packet is issued only when nothing can stop it.
class ArraySlice : public sc_core::sc_module, private Pumped {
public:
    struct Config {
        int width = 8;            ///< PEs
        int writeback_cycles = 4; ///< execution to pixel state written back (paper: 4)
        TerminationGrain termination = TerminationGrain::Segment;
        int region_listeners = 0; ///< Slicing Units of a stream if they skip dead rows, else 0
        int streams = 1;          ///< tile streams
        int contexts = 1;         ///< tiles of a stream that the Pixel Buffer holds
        bool scoreboard = true;   ///< no pixel comes again before its write-back
        bool tests = false;       ///< PEs test whether their pixel is inside the ellipse
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
    // Once per tile, one port per stream; with several streams kNoTile ends the reports.
    sc_core::sc_vector<FifoPort<SliceReport>> tile_done;  ///< to the Pixel Buffer
    sc_core::sc_vector<FifoPort<SliceReport>> tile_state; ///< to the Tile Monitor

    ArraySlice(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, int index, int slices, int segment_length);

    const Stats& stats() const { return stats_; }
    /// Records executed tasks in `part`, which may be null; before the simulation starts.
    void record(SlotPart* part) { part_ = part; }

private:
    /// Runs the slice in place of itself if its tasks are recorded, so that pump() need not ask.
    class RecordedPump : public Pumped {
    public:
        explicit RecordedPump(ArraySlice& slice) : slice_(slice) {}
        void pump() override { slice_.pump_packets<true>(); }

    private:
        ArraySlice& slice_;
    };
    struct Recent {
        Cycle date = 0;
        std::uint32_t mask = 0;
    };
    /// Tile state: what is still alive in this slice's rows.
    struct Context {
        TileNumber tile = kNoTile;
        int live_pixels = 0;
        bool reported = false;
        std::vector<int> live_in_segment;
        std::vector<std::uint32_t> ended_in_segment;
        std::vector<Recent> recent; ///< per segment: pixels updated lately
    };
    void end_of_elaboration() override;
    void run();
    void pump() override;
    /// The context, prepared for the tile if that starts with this call.
    Context& context_of(std::int16_t context, TileNumber tile) {
        if (current_->tile != tile) {
            current_ = &contexts_[context];
            if (current_->tile != tile) {
                start_tile(*current_, tile);
            }
        }
        return *current_;
    }
    [[gnu::noinline]] void start_tile(Context& context, TileNumber number);
    template <bool Recorded>
    void execute(const TaskPacket& packet);
    template <bool Recorded>
    void pump_packets();
    /// The tasks of `run` that are in this packet, from the outcome of its segment.
    void record(const TaskRun& run, Cycle date);
    // What is rare stays out of the loop over packets, which then keeps more in registers.
    [[noreturn, gnu::noinline]] void refuse(const TaskPacket& packet) const;
    [[gnu::noinline]] BlendOutcome blend_otherwise(const Context& context, const TaskRun& run,
                                                   Cycle date);
    BlendOutcome blend_early(const Context& context, const TaskRun& run, Cycle date);
    void check_reuse(Context& context, const TaskRun& run, Cycle date);
    [[gnu::noinline]] void pixels_ended(Context& context, const TaskRun& run, std::uint32_t ended);
    void report_region(const Context& context, const TaskRun& run);
    [[gnu::noinline]] void end_tile(TileNumber number, std::int16_t context);
    void end_reports();
    std::size_t stream_of(std::int16_t context) const { return context / config_.contexts; }

    Config config_;
    RenderJob& job_;
    int index_, slices_, segment_length_, segments_per_row_;
    Process self_;
    DatedFifo<TaskPacket>* packets_ = nullptr; // the ring behind `in`
    std::vector<Context> contexts_;            // those in use have taken host memory
    Context* current_;                         // asked for last
    int segments_;                             // of a context
    std::vector<std::size_t> port_of_row_; // in region_ended, of a stream; empty without listeners
    BlendOutcome outcome_; // of the segment whose tasks execute, or of the part without scoreboard
    bool plain_;           // solved tasks and a scoreboard: asked once per segment, so in one place
    TaskBlender blender_;
    std::optional<EarlyBlender> early_; // without scoreboard
    std::size_t tiles_done_ = 0;
    SlotPart* part_ = nullptr;
    RecordedPump recorded_{*this};
    Stats stats_;
};

} // namespace degs
