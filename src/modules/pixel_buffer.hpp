// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/render_job.hpp"
#include "modules/traffic.hpp"
#include "tlm/config.hpp"
#include "tlm/dated_fifo.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// When a tile context may hold the next tile. `Tile`: once all slices have finished. `Bank`: the
/// Pixel Buffer is banked by row like the Issue Banks, and each bank hands its rows back on its
/// own.
enum class ContextRelease { Tile, Bank };

/// Holds the pixels of the tiles in flight (paper Table I, "Pixel Buffer") and writes finished
/// tiles to the frame buffer in memory as RGBA8 or RGBA16F. A context is free again once every
/// slice has finished its tile and the pixels have been read out; the write itself is
/// posted. Tiles that no splat touches are written as background while the pipeline starts.
/// One instance serves the rows y = first, first + stride, ...: all of them, or one bank's.
class PixelBuffer : public sc_core::sc_module {
public:
    struct Config {
        int bytes = 16384;        ///< capacity
        int state_bytes = 16;     ///< per pixel: T and three colours
        int readout_pixels = 64;  ///< read out per cycle
        int writes_in_flight = 4; ///< tile writes not yet acknowledged
        ContextRelease release = ContextRelease::Tile;
        void describe(ConfigVisitor& visitor);
        /// Tile contexts that fit; 0 if not even one does.
        int contexts(int tile_size) const { return bytes / (state_bytes * tile_size * tile_size); }
    };
    struct Stats {
        Cycle readout_busy = 0;
        Cycle write_wait = 0; ///< ready to read out, but too many writes were in flight
        Cycle finished = 0;   ///< date at which the last pixel was in memory
        std::uint64_t tiles = 0, background_tiles = 0;
    };

    sc_core::sc_vector<FifoPort<SliceReport>> in;          ///< one per array slice
    sc_core::sc_vector<FifoPort<TileNumber>> context_free; ///< one per bank
    MemoryPort frame_buffer;

    PixelBuffer(const sc_core::sc_module_name& name, const Config& config,
                const TrafficConfig& traffic, const Timebase& time, RenderJob& job,
                std::size_t slices, int contexts, int first_row, int row_stride);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void run();
    void clear(int context);
    void write_background();
    void finish_tile(TileNumber number);
    Cycle write_rows(TileNumber number);
    const std::vector<unsigned char>& read_out(TileNumber number, int y);

    Config config_;
    TrafficConfig traffic_;
    RenderJob& job_;
    int contexts_;
    int first_row_, row_stride_;
    Process self_;
    Cycle written_ = 0;                // completion of the latest write
    std::vector<Cycle> in_flight_;     // ring of completion dates of the latest tile writes
    std::vector<PixelValue> pixels_;   // of the row being read out
    std::vector<unsigned char> bytes_; // the same as frame-buffer pixels
    Stats stats_;
};

} // namespace degs
