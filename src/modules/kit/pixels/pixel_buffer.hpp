// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include <systemc>

#include "config/config.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/traffic.hpp"
#include "modules/kit/pixels/pixel_source.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// When a tile context may hold the next tile. `Tile`: once all slices have finished.
/// `Bank`: the Pixel Buffer is banked by row like the Issue Banks, and each bank hands
/// its rows back on its own.
enum class ContextRelease { Tile, Bank };

/// Holds the pixels of the tiles in flight (paper Table I, "Pixel Buffer") and writes finished
/// tiles to the frame buffer in memory as RGBA8 or RGBA16F. A context is free again once every
/// slice has finished its tile and the pixels have been read out; the write itself is posted. An
/// instance serves a share of the pixels: all of them, one bank's rows, or the tiles that are
/// granted to one engine.
class PixelBuffer : public sc_core::sc_module {
public:
    /// Decides the size of a tile context, together with Config::state_bytes.
    struct TilePixels {
        int side = 32;  ///< px
        int bits = 128; ///< that the numbers need for T and three colours of a pixel
    };
    struct Config {
        int bytes = 16384;        ///< capacity
        int state_bytes = 16;     ///< per pixel: T and three colours; 0: what the numbers need
        int readout_pixels = 64;  ///< read out per cycle
        int writes_in_flight = 4; ///< tile writes not yet acknowledged
        int rows_per_cycle = 2;   ///< of pixels that leave for memory
        int free_cycles = 1;      ///< from the end of a readout to the array
        ContextRelease release = ContextRelease::Tile;
        void describe(ConfigVisitor& visitor);
        /// Requires room for `tiles` contexts, and for no more than `most`; `section` is where
        /// these keys stand, `others` decide the size of a tile.
        void require_tiles(ConfigVisitor& visitor, const std::string& section, TilePixels tile,
                           int tiles, std::vector<const char*> others,
                           int most = kMostContexts) const;
        /// Tile contexts that fit; 0 if not even one does.
        int contexts(TilePixels tile) const {
            return static_cast<int>(bytes / tile_bytes(tile)); // as bytes, below 2^31
        }
        /// One of so many equal parts, each with tile contexts of its own.
        Config part_of(int parts) const;
        /// Bytes of the pixel state of one tile, whole ones.
        std::int64_t tile_bytes(TilePixels tile) const;
        /// Bytes of the state of one pixel, which need not be whole ones.
        double pixel_bytes(TilePixels tile) const { return bits(tile) / 8.0; }

    private:
        int bits(TilePixels tile) const { return state_bytes == 0 ? tile.bits : 8 * state_bytes; }
    };
    struct Stats {
        Cycle readout_busy = 0;
        Cycle write_wait = 0;
        Cycle finished = 0; ///< date at which the last pixel was in memory
        std::uint64_t tiles = 0;
        void describe(StatsVisitor& v) const {
            v.count("readout_cycles", readout_busy, "cycles", "Reading out finished tiles.");
            v.count("write_wait_cycles", write_wait, "cycles",
                    "Finished tiles waiting because too many writes were in flight.");
        }
    };
    /// The pixels of this instance, and where it keeps them.
    struct Share {
        int first_row = 0, row_stride = 1; ///< rows y = first, first + stride, ... of every tile
        int first_context = 0;             ///< in the data path
        /// Tiles come one by one, ascending, until kNoTile, and use this instance's contexts in
        /// turn; else all tiles of the job come, and tile t uses context t modulo the contexts.
        bool granted = false;
    };

    sc_core::sc_vector<FifoPort<SliceReport>> in; ///< one per array slice
    /// The tile that may now use its context, one per bank; of granted tiles only the
    /// number of messages counts.
    sc_core::sc_vector<FifoPort<TileNumber>> context_free;
    /// Sends the frame of every tile written to the Frame Gate; empty without one.
    sc_core::sc_vector<FifoPort<std::uint32_t>> frame_done;
    MemoryPort frame_buffer;

    /// `instant`: a context is free again at once, see BuildOptions.
    PixelBuffer(const sc_core::sc_module_name& name, const Config& config,
                const TrafficConfig& traffic, const Timebase& time, RenderJob& job,
                std::size_t slices, int contexts, const Share& share, bool gated = false,
                bool instant = false);

    const Stats& stats() const { return stats_; }
    /// Pixels of its share that it reads out per cycle at most.
    int pixels_per_cycle() const { return std::max(1, config_.readout_pixels / share_.row_stride); }
    /// Reads the pixels of tiles from `source` in place of the data path; before the simulation
    /// starts.
    void read_from(PixelSource& source) { source_ = &source; }
    /// Dates at which each frame's last pixel of this share was in memory.
    const KeptList<Cycle>& frames_written() const { return frames_written_; }

private:
    void end_of_elaboration() override;
    void run();
    void clear(TileNumber number);
    TileNumber next_tile();
    void note_frames(std::size_t frames);
    void finish_tile(TileNumber number);
    int context_of(TileNumber number) const;
    Completion write_rows(TileNumber number);
    const std::vector<unsigned char>& read_out(TileNumber number, int y);

    Config config_;
    TrafficConfig traffic_;
    RenderJob& job_;
    int contexts_;
    Share share_;
    bool instant_;
    PixelSource* source_ = nullptr; // nullptr: pixels lie in the contexts
    Process self_;
    Completion written_;                // completion of the latest write
    Cycle read_out_ = 0;                // date at which the latest pixel had been read out
    std::vector<Completion> in_flight_; // ring of completion dates of the latest tile writes
    std::vector<PixelValue> pixels_;    // of the row being read out
    std::vector<unsigned char> bytes_;  // of the row, as frame-buffer pixels
    KeptList<Cycle> frames_written_;    // from RenderJob::first_dated() on
    Stats stats_;
};

} // namespace degs
