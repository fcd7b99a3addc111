// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/collect.hpp"
#include "modules/front_end/frame_ends.hpp"
#include "modules/front_end/reuse_cache.hpp"
#include "modules/front_end/tile_front_end.hpp"
#include "modules/front_end/tile_grants.hpp"
#include "modules/main_memory_config.hpp"
#include "modules/memory_streams.hpp"
#include "modules/render_engine.hpp"
#include "modules/span_engine/tile_monitor.hpp"

namespace degs {

/// An accelerator of several engines behind a Tile Front End, each on a tile of its own. This class has everything but
/// the engines:
///
///   Tile Front End -> List Collectors -> Tile Dispatcher -> per engine: Splat Fetcher, perhaps with a
///   reuse cache -> [buffer] -> (engine) -> Pixel Buffer -> memory
///
/// Engines ask for a tile when their fetcher has handed on the one before. A derived class builds its engines in its
/// constructor, calls connect() with each and then connect_memory(). TileArrayEngine is the same for one array.
class TileEngineArray : public RenderEngine {
public:
    struct Parts {
        TileFrontEnd::Config front;
        SplatFetcher::Config fetching;
        PixelBuffer::Config
            pixel_buffer; ///< of all engines; each reads out at its share of the rate
        TileMonitor::Config monitor;
        MainMemoryConfig memory;
        FrameEndConfig frame_end;
        int engines = 1;
        int contexts = 1;         ///< tiles of one engine whose pixels are on chip
        int splat_chunks = 1;     ///< in front of an engine
        int cache_records = 0;    ///< of an engine's reuse cache; 0: it has none
        int writeback_cycles = 1; ///< report of a tile to its pixels written back
    };

    std::size_t finished_tiles() const override;
    void collect(AcceleratorResult& result) const override;

    const TileFrontEnd& front_end() const { return *front_end_; }
    const TileDispatcher& dispatcher() const { return grants_->dispatcher(); }
    const std::vector<std::unique_ptr<SplatFetcher>>& fetchers() const { return fetchers_; }
    const std::vector<std::unique_ptr<ReuseCache>>& caches() const { return caches_; }
    const PixelBuffers& pixel_buffers() const { return pixel_buffers_; }
    const std::vector<std::unique_ptr<TileMonitor>>& monitors() const { return monitors_; }
    const MemoryStreams& streams() const { return streams_; }
    RingUse splat_buffer() const { return use_of(splat_rings_); }

protected:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    TileEngineArray(const sc_core::sc_module_name& name, const Parts& parts, const Timebase& time,
                    RenderJob& job, const BuildOptions& options);

    /// Wires the ports `in`, `context_free`, `tile_done` and `tile_state` of the next engine, which lives in the
    /// contexts from first_context() of its index on.
    template <class Engine>
    void connect(Engine& engine) {
        const std::size_t index = connected_++;
        engine.in.bind(*splat_rings_[index]);
        engine.context_free.bind(*context_rings_[index]);
        engine.tile_done.bind(*done_rings_[index]);
        engine.tile_state.bind(*state_rings_[index]);
    }
    int first_context(int engine) const { return engine * parts_.contexts; }
    /// Slots of all engines: an engine of `width` PEs knows its own from its first to its last.
    static void add_slots(AcceleratorResult& result, const SlotAccount& slots,
                          const ActiveWindow& window);
    static void close_slots(AcceleratorResult& result, const ActiveWindow& window,
                            std::uint64_t width);

    /// Fills slots, window, stages, buffers, activity and invariants of the engines. Called when the stages of the
    /// front end and the fetchers are there.
    virtual void collect_engines(AcceleratorResult& result) const = 0;

    const Timebase& time() const { return time_; }
    RenderJob& job() const { return job_; }
    std::uint64_t list_entries() const;
    std::uint64_t records_fetched() const {
        return sum_of(fetchers_, &SplatFetcher::Stats::records);
    }
    std::uint64_t records_cancelled() const {
        return sum_of(fetchers_, &SplatFetcher::Stats::records_cancelled);
    }

private:
    void build_front_end();
    void build_caches();
    void build_fetcher(int index);
    void build_pixel_buffer(int index);
    void build_memory();

    Parts parts_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;
    std::size_t connected_ = 0; // engines

    std::unique_ptr<TileFrontEnd> front_end_;
    Process nobody_; // writes cancellations that never come: a granted list is sorted to its end
    std::unique_ptr<TileGrants> grants_;
    NextUses next_uses_;
    std::vector<std::unique_ptr<ReuseCache>> caches_;
    std::vector<std::unique_ptr<SplatFetcher>> fetchers_;
    PixelBuffers pixel_buffers_;
    std::vector<std::unique_ptr<TileMonitor>> monitors_;
    FrameEnds frame_ends_;
    MemoryStreams streams_;

    Rings<SplatChunk> splat_rings_;
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
};

} // namespace degs
