// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "baselines/gscore/chunk_inputs.hpp"
#include "baselines/gscore/oriented_boxes.hpp"
#include "config/config.hpp"
#include "modules/kit/job/array_share.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/slot_account.hpp"
#include "splat/frame/subtile_cover.hpp"
#include "stats/statistics.hpp"

namespace degs::gscore {

/// The volume rendering cores of GSCore: a fixed square of pixel lanes in lock step (paper, Sec.
/// II-B; Lee et al., ASPLOS 2024). A tile is cut into sub-tiles of the lanes' size. For each splat
/// in depth order, each sub-tile that its bitmap names and that is not done takes one slot, in
/// which every lane evaluates the splat at its own pixel, useful or not. A sub-tile is done when
/// its last pixel has ended; the result of a slot guides the slots `termination_cycles` later. The
/// tile stops when all its sub-tiles are done; splats of it that still come are dropped at no cost.
///
/// Updates of a pixel in neighbouring cycles are forwarded (initiation interval 1), tiles follow
/// each other without a bubble while a context is free, and a splat whose bits are all clear or
/// done costs no cycle unless `skips_per_cycle` says so. All of this favours the design.
class LockstepArray : public sc_core::sc_module {
public:
    struct Config {
        int lanes = 64; ///< pixels evaluated per cycle: a square of 4, 8, 16 or 32 px
        SubtileTest subtile_skip = SubtileTest::Obb;
        int subtiles = 2;           ///< side of a tile in sub-tiles
        int skips_per_cycle = 0;    ///< splats without a slot that are passed per cycle; 0: any
        int clusters = 1;           ///< groups of lanes that work through the list on their own
        int termination_cycles = 1; ///< from the slot that ends a sub-tile to the first that skips
        int pipeline_cycles = 4;    ///< last slot of a tile to its pixels written back
        void describe(ConfigVisitor& visitor);
        /// Side of the square of lanes and of a sub-tile, px.
        int side() const;
        /// px; never smaller than 16.
        int tile_size() const;
    };
    struct Stats {
        SlotAccount slots; ///< of all lanes over the window
        ActiveWindow window;
        std::uint64_t tiles = 0; ///< begun
        std::uint64_t passes = 0, splats = 0, splats_skipped = 0, splats_discarded = 0;
        std::uint64_t pixels_ended = 0, tiles_stopped = 0;
        void describe(StatsVisitor& v) const { // slots are described by the result
            v.count("passes", passes, "passes", "Sub-tiles evaluated; each takes all lanes once.");
            v.count("splats", splats, "splats", "Splats taken in.");
            v.count("splats_skipped", splats_skipped, "splats",
                    "Splats taken in that needed no slot.");
            v.count("splats_discarded", splats_discarded, "splats",
                    "Splats that came when their tile had stopped.");
            v.count("tiles_stopped", tiles_stopped, "tiles",
                    "Tiles that stopped before the end of their list.");
            v.count("pixels_ended", pixels_ended, "pixels",
                    "Pixels that ended before the end of their list.");
        }
    };

    sc_core::sc_vector<FifoPort<SplatChunk>> in; ///< tile t arrives on port t mod their number
    FifoPort<TileNumber> context_free; ///< one message for each tile from tile `contexts` on
    FifoPort<SliceReport> tile_done;   ///< to the Pixel Buffer, once per tile
    FifoPort<SliceReport> tile_state;  ///< to the Tile Monitor, once per tile

    /// The job's tiles are whole multiples of config.side(), at most 32 sub-tiles. If tiles are
    /// granted, both reports end with kNoTile. `boxes` are those of the job and must outlive this.
    LockstepArray(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
                  RenderJob& job, OrientedBoxes& boxes, const ArrayShare& share);

    const Config& config() const { return config_; }
    const Stats& stats() const { return stats_; }

private:
    void pass_over(Cycle begin);
    /// Lanes that share one place in the list. One cluster: the whole array.
    struct Cluster {
        Cycle first = kNever;     ///< first cycle of work
        Cycle free = 0;           ///< the cycle after the last one
        Cycle blocked = 0;        ///< blocked_ when it last worked
        SlotPart* part = nullptr; ///< if slots are recorded
    };
    struct Subtile {
        int live = 0;             ///< pixels that take splats
        Cycle done_from = kNever; ///< first cycle whose slot sees that all pixels have ended
    };
    void end_of_elaboration() override;
    void run();
    void render_tile(TileNumber number);
    void start_tile(TileNumber number);
    bool await_chunk(DatedFifo<SplatChunk>& source);
    void await_context();
    void work(const SplatChunk& chunk, Cycle begin);
    SubtileMask bitmap(std::uint32_t splat) const;
    SubtileMask tested(std::uint32_t splat) const;
    bool all_done(Cycle begin);
    bool issue(std::uint32_t splat, SubtileMask mask, Cycle begin);
    void pass(int subtile, std::uint32_t splat, Cycle at);
    int evaluate(int subtile, std::uint32_t splat);
    void account_wait(Cluster& cluster, Cycle at);
    int record_pass(const Cluster& cluster, Cycle at, int subtile, std::uint32_t splat);
    void record_wait(const Cluster& cluster, Cycle at, Cycle blocked);
    void close_window();

    /// Pixels of the tile in the image, relative to its corner; may be empty.
    PixelBox pixels_of(int subtile) const;
    Cluster& cluster_of(int subtile) { return clusters_[subtile % config_.clusters]; }

    Config config_;
    RenderJob& job_;
    ArrayShare share_;
    Process self_;
    ChunkInputs chunks_;
    SubtileGrid grid_;
    OrientedBoxes& boxes_; // empty unless the bitmap needs them
    std::vector<Cluster> clusters_;
    std::vector<Subtile> subtiles_;
    std::vector<BlendOutcome> outcomes_; // of the rows of the present sub-tile
    SubtileMask inside_ = 0;             // sub-tiles with a pixel in the image
    int live_subtiles_ = 0;
    const JobTile* tile_ = nullptr;
    TileNumber number_ = 0;
    int context_ = 0;
    std::uint64_t startable_;    // so many tiles have had a context
    Cycle blocked_ = 0;          // cycles spent waiting for contexts so far
    bool recorded_ = false;      // slots, with their dates
    TimeSeries* busy_ = nullptr; // cycles of the clusters, in the timeline
    Cycle scanned_ = 0;          // before it no splat is looked at
    int passed_over_ = 0;        // splats without a slot since the last slot or cycle of passing
    Stats stats_;
};

} // namespace degs::gscore
