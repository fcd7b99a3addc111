// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "modules/kit/job/array_share.hpp"
#include "modules/kit/job/render_job.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs::row_sweep {

/// One PE for each column of a tile. A splat takes a slot for each row of the tile that it meets,
/// and every PE tests its pixel of that row. Nothing is packed: PEs beside the splat do nothing
/// useful.
class Array : public sc_core::sc_module {
public:
    struct Config {
        int count = 4;           ///< arrays, each on a tile of its own
        int latency_cycles = 10; ///< from the last slot of a tile to its pixels written back
        bool skip_ended = false; ///< rows whose pixels have all ended take no slot
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        SlotAccount slots;
        ActiveWindow window;
        Cycle busy = 0;
        std::uint64_t tiles = 0, splats = 0, abandoned = 0, rows_skipped = 0;
        void describe(StatsVisitor& visitor) const;
    };

    FifoPort<SplatChunk> in; ///< tile by tile, near to far; at the end kNoTile
    FifoPort<TileNumber> context_free;
    FifoPort<SliceReport> tile_done, tile_state;

    Array(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
          RenderJob& job, const ArrayShare& share);
    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void run();
    bool start_tile();
    void take(const SplatChunk& chunk);
    void sweep(std::uint32_t splat);
    void execute(PixelTest& test);
    void account_idle();
    void add(Slot slot, Cycle from, Cycle to, std::uint64_t count);
    void report_tile();
    std::uint64_t width() const { return static_cast<std::uint64_t>(job_.tile_size); }

    Config config_;
    RenderJob& job_;
    ArrayShare share_;
    Process self_;
    SlotPart* part_; // nullptr unless slots are recorded
    TileNumber number_ = 0;
    const JobTile* tile_ = nullptr;
    int context_ = 0;
    int live_ = 0;                 // pixels of the tile that have not ended
    std::vector<int> live_in_row_; // by row of the tile
    bool reported_ = false;        // the tile, whose pixels change no more
    Cycle blocked_ = 0;            // cycles without a context since the last slot
    Cycle free_ = 0;               // the cycle after the last slot
    Stats stats_;
};

} // namespace degs::row_sweep
