// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/collect.hpp"
#include "modules/front_end/frame_ends.hpp"
#include "modules/front_end/tile_front_end.hpp"
#include "modules/main_memory_config.hpp"
#include "modules/memory_streams.hpp"
#include "modules/render_engine.hpp"
#include "modules/span_engine/tile_monitor.hpp"

namespace degs {

/// An accelerator of one array behind a Tile Front End. This class has everything but the array:
///
///   Tile Front End -> Splat Fetchers -> [buffer] -> (array) -> Pixel Buffer -> memory
///
/// There is one way back: a tile whose pixels have all ended is cancelled upstream. A derived
/// class builds its array in its constructor and hands over the ports;
/// docs/adding-an-accelerator.md is a worked example.
class TileArrayEngine : public RenderEngine {
public:
    struct Parts {
        TileFrontEnd::Config front;
        SplatFetcher::Config fetching;
        PixelBuffer::Config pixel_buffer;
        TileMonitor::Config monitor;
        MainMemoryConfig memory;
        FrameEndConfig frame_end;
        int contexts = 1;         ///< tiles whose pixels are on chip
        int splat_chunks = 1;     ///< that each fetcher's share of the buffer holds
        int buffer_bytes = 0;     ///< of that buffer, for reports
        double pixel_bytes = 16;  ///< of the state of a pixel
        int writeback_cycles = 1; ///< last update of a tile to its pixels written back
    };

    std::size_t finished_tiles() const override;
    void collect(AcceleratorResult& result) const override;

protected:
    TileArrayEngine(const sc_core::sc_module_name& name, const Parts& parts, const Timebase& time,
                    RenderJob& job, const BuildOptions& options);

    /// Splat streams that the array reads; tile t comes on stream t modulo their number.
    std::size_t streams() const { return fetchers_.size(); }
    /// Wires the ports of an array: `in` (one per stream), `context_free`, `tile_done`,
    /// `tile_state`.
    template <class Array>
    void connect(Array& array) {
        for (std::size_t i = 0; i < streams(); ++i) {
            array.in[i].bind(*splat_rings_[i]);
        }
        array.context_free.bind(*context_rings_.front());
        array.tile_done.bind(*report_rings_[0]);
        array.tile_state.bind(*report_rings_[1]);
    }

    /// Fills slots, window, and the stages, activity and invariants of the array.
    virtual void collect_array(AcceleratorResult& result) const = 0;

    const TileFrontEnd& front_end() const { return *front_end_; }
    std::uint64_t list_entries() const;
    std::uint64_t records_fetched() const {
        return sum_of(fetchers_, &SplatFetcher::Stats::records);
    }

private:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    void build_front_end(const Timebase& time);
    void build_pixels(const Timebase& time);

    Parts parts_;
    RenderJob& job_;
    BuildOptions options_;
    std::unique_ptr<TileFrontEnd> front_end_;
    std::vector<std::unique_ptr<SplatFetcher>> fetchers_;
    PixelBuffers pixel_buffers_; // one
    std::unique_ptr<TileMonitor> monitor_;
    FrameEnds frame_ends_;
    MemoryStreams streams_;

    Rings<SortedRun> sorted_rings_;
    Rings<SplatChunk> splat_rings_;
    Rings<SliceReport> report_rings_; // to the Pixel Buffer, to the Tile Monitor
    Rings<TileNumber> context_rings_, cancel_rings_;
};

} // namespace degs
