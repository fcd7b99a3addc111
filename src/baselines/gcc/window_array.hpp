// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "baselines/gcc/messages.hpp"
#include "baselines/gcc/traversal.hpp"
#include "config/config.hpp"
#include "modules/kit/job/array_share.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/slot_account.hpp"
#include "stats/statistics.hpp"

namespace degs::gcc {

/// Stage IV of GCC: alpha and blending arrays in lock step (paper, Sec. II-B; Pei et al., MICRO
/// 2025). A square window of PEs wanders over the pixels of a view. For each splat in exact depth
/// order it starts where the centre is (clamped to the view) and goes on to every neighbouring
/// window across whose side the splat is valid; each visited window takes one slot in which all PEs
/// evaluate the splat at their pixel. Windows whose pixels have all ended are passed without
/// evaluation. Views (here: the tiles of a job) follow one after the other.
///
/// The neighbours that a slot finds are known `discovery_cycles` later. With 1, splats are
/// interleaved so well that the array never waits. With more, one splat is in flight, and the array
/// waits, in class `conflict`, for its next window or for the certainty that there is none.
///
/// A splat's valid pixels may lie apart, because its centre is outside the view or because it is
/// thinner than the pixel grid. When the frontier is empty and valid windows are left, the
/// traversal is seeded again at the first of them, so that the image is right; the papers do not
/// say how the hardware finds it.
class WindowArray : public sc_core::sc_module {
public:
    struct Config {
        int window = 8;           ///< side of the window, px; its square is the number of PEs
        int skip_cycles = 0;      ///< for a window whose pixels have all ended
        int discovery_cycles = 1; ///< from a slot to the slots that it leads to
        int seed_cycles = 0;      ///< to find where another part of a splat begins
        int writeback_cycles = 4; ///< from a slot to pixel state and reports
        void describe(ConfigVisitor& visitor);
        int pes() const { return window * window; }
    };
    struct Stats {
        SlotAccount slots;
        ActiveWindow window;
        std::uint64_t windows = 0, windows_empty = 0, windows_ended = 0;
        std::uint64_t skip_cycles = 0, valid_pixels = 0, extra_seeds = 0;
        std::uint64_t splats = 0, splats_dropped = 0, pixels_ended = 0;
        void describe(StatsVisitor& v) const { // slots are described by the result
            v.count("windows", windows, "windows", "Windows evaluated, one in each busy cycle.");
            v.count("windows_empty", windows_empty, "windows",
                    "Evaluated windows without a valid pixel.");
            v.count("windows_ended", windows_ended, "windows",
                    "Windows passed without evaluation: all their pixels had ended.");
            v.count("splats", splats, "splats", "Splats traversed.");
            v.count("splats_dropped", splats_dropped, "splats",
                    "Splats that came when all pixels of their view had ended.");
            v.count("extra_seeds", extra_seeds, "windows",
                    "Further windows from which the traversal of a splat began.");
            v.count("pixels_ended", pixels_ended, "pixels",
                    "Pixels that ended before the end of their list.");
            v.count("valid_pixels", valid_pixels, "pixels",
                    "Pixels inside the ellipse in evaluated windows.");
            v.count("skip_cycles", skip_cycles, "cycles",
                    "Passing ended windows, between the first slot and the last.");
        }
    };

    sc_core::sc_vector<FifoPort<SplatChunk>> in; ///< tile t arrives on port t mod their number
    FifoPort<TileNumber> context_free; ///< one message for each tile from tile `contexts` on
    FifoPort<SliceReport> tile_done;   ///< to the Pixel Buffer, once per tile
    FifoPort<SliceReport> tile_state;  ///< to the Tile Monitor, once per tile
    sc_core::sc_vector<FifoPort<BlockEnded>> block_ended; ///< to Stage III; may be empty

    /// The job's tile size is at most 64 windows. If views are granted, both reports end with
    /// kNoTile. `block`: side of the blocks that are reported, px.
    WindowArray(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
                RenderJob& job, const ArrayShare& share, std::size_t listeners = 0, int block = 8);

    const Config& config() const { return config_; }
    const Stats& stats() const { return stats_; }
    /// Entries of the list of its first view; 0 if it has had none.
    std::uint64_t first_entries() const { return first_entries_; }

private:
    /// A pixel that the splat has ended; they are chained by window.
    struct EndedPixel {
        int block = 0;
        int next = -1;
    };
    void end_of_elaboration() override;
    void run();
    SplatChunk next_chunk();
    void render_view(SplatChunk chunk);
    void start_view(TileNumber number);
    void await_context();
    void end_view();
    void render(std::uint32_t splat, const ProjectedSplat& projected);
    void evaluate(std::uint32_t splat);
    void evaluate_run(std::uint32_t splat, int y, const PixelRange& columns);
    void note_ended(int y, int column, std::uint32_t ended);
    Traversal::Window centre_window(const ProjectedSplat& splat) const;
    void traverse(const ProjectedSplat& splat);
    std::optional<Traversal::Window> missed();
    void visit(const Traversal::Window& window);
    void end_pixels(std::size_t window);
    void report_block(int block);
    void wait_until(Cycle date);
    void idle(Slot cause, Cycle from, Cycle to);
    void settle_idle();
    void record_splat(std::uint64_t useful, std::uint64_t terminated);
    std::size_t window_at(int row, int column) const { return row * grid_ + column; }

    Config config_;
    RenderJob& job_;
    ArrayShare share_;
    int block_, blocks_; // side in px; per row of the largest view
    int grid_;           // windows per row of the largest view
    Process self_;
    Footprint footprint_;
    Traversal traversal_;
    const JobTile* view_ = nullptr;
    std::uint64_t first_entries_ = 0;
    TileNumber number_ = 0;
    int context_ = 0;
    PixelRange columns_, rows_; // windows with a pixel of the image
    std::uint64_t views_ = 0;   // that are over
    std::uint64_t startable_;   // so many views have had a context
    int live_pixels_ = 0;
    bool reported_ = false;
    std::vector<int> live_in_window_, live_in_block_;
    std::vector<WindowMask> live_windows_; // per row of windows
    std::vector<int> ended_head_;          // per window: the splat's first EndedPixel, or -1
    std::vector<EndedPixel> ended_;
    SlotAccount pending_idle_; // counts once another slot follows
    Cycle pending_skips_ = 0;
    bool idle_pending_ = false;
    SlotPart* part_ = nullptr;  // if slots are recorded
    std::vector<Cycle> visits_; // of the splat, if slots are recorded
    Stats stats_;
};

} // namespace degs::gcc
