// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <systemc>

#include "modules/kit/accelerator/render_engine.hpp"
#include "modules/kit/config/main_memory_config.hpp"
#include "modules/kit/engine/collect.hpp"
#include "modules/kit/engine/frame_ends.hpp"
#include "modules/kit/engine/tile_front_end.hpp"
#include "modules/kit/engine/tile_grants.hpp"
#include "modules/kit/front_end/reuse_cache.hpp"
#include "modules/kit/front_end/tile_monitor.hpp"
#include "modules/kit/job/array_share.hpp"
#include "modules/kit/memory/memory_streams.hpp"
#include "tlm/rings.hpp"

namespace degs {

/// An accelerator of one or several engines behind a Tile Front End. This class has everything but
/// the engines. Tiles are either granted, so that each engine is on a tile of its own and asks for
/// the next one when its fetcher has handed on the one before:
///
///   Tile Front End -> List Collectors -> Tile Dispatcher -> per engine: Splat Fetcher, perhaps
///   with a reuse cache -> [buffer] -> (engine) -> Pixel Buffer -> memory
///
/// or the only engine gets all tiles, from a Splat Fetcher for each sorter:
///
///   Tile Front End -> Splat Fetchers -> [buffer] -> (engine) -> Pixel Buffer -> memory
///
/// A tile whose pixels have all ended is not fetched any further; if tiles are not granted, neither
/// is it sorted. A derived class builds its engines in its constructor and calls connect() with
/// each.
class TiledAccelerator : public RenderEngine {
public:
    struct Parts {
        TileFrontEnd::Config front;
        SplatFetcher::Config fetching;
        PixelBuffer::Config pixel_buffer; ///< of one engine
        TileMonitor::Config monitor;
        MainMemoryConfig memory;
        FrameEndConfig frame_end;
        bool granted = false; ///< tiles; several engines need it
        int engines = 1;
        int grant_cycles = 1; ///< see AcceleratorConfig
        int contexts = 1;     ///< tiles of one engine whose pixels are on chip
        int splat_chunks =
            1; ///< that each fetcher's share of the buffer in front of an engine holds
        const char* splat_rings = "splats"; ///< name of these rings in timelines
        int cache_records = 0;              ///< of an engine's reuse cache; 0: it has none
        int writeback_cycles = 1;           ///< report of a tile to its pixels written back

        Parts() = default;
        /// The sections that the configurations of such accelerators share, with hierarchical
        /// sorters.
        template <class Config>
        explicit Parts(const Config& config)
            : fetching(config.fetching), pixel_buffer(config.pixel_buffer), monitor(config.monitor),
              memory(config.memory), frame_end(config.frame_end),
              grant_cycles(config.grant_cycles) {
            front.projection = config.projection;
            front.binning = config.binning;
            front.hierarchical = config.sorting;
            front.on_demand = true;
            front.traffic = config.traffic;
            front.sort_capacity = config.sort_capacity();
            front.frames_in_flight = config.frames_in_flight;
        }
    };

    std::size_t finished_tiles() const override;
    void collect(AcceleratorResult& result) const override;

    const TileFrontEnd& front_end() const { return *front_end_; }
    /// Tiles must be granted.
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

    TiledAccelerator(const sc_core::sc_module_name& name, const Parts& parts, const Timebase& time,
                     RenderJob& job, const BuildOptions& options);

    /// What the engine of this index works on.
    ArrayShare share_of(int engine) const {
        return {inputs(), parts_.contexts, first_context(engine), parts_.granted};
    }
    int first_context(int engine) const { return engine * parts_.contexts; }
    /// Wires the ports `in`, `context_free`, `tile_done` and `tile_state` of the next engine. `in`
    /// is a port, or a vector of share_of().inputs ports.
    template <class Engine>
    void connect(Engine& engine) {
        const std::size_t index = connected_++;
        bind_inputs(engine.in, index * inputs());
        engine.context_free.bind(*context_rings_[index]);
        engine.tile_done.bind(*done_rings_[index]);
        engine.tile_state.bind(*state_rings_[index]);
    }
    /// The name of a block of which every engine has one.
    std::string name_of(const char* block, int engine) const {
        return parts_.granted ? numbered(block, engine) : block;
    }
    /// Fills slots, window, stages, buffers, activity and invariants of the engines. Called when
    /// the stages of the front end and the fetchers are there.
    virtual void collect_engines(AcceleratorResult& result) const = 0;

    const Timebase& time() const { return time_; }
    RenderJob& job() const { return job_; }
    bool granted() const { return parts_.granted; }
    std::uint64_t list_entries() const;
    std::uint64_t records_fetched() const {
        return sum_of(fetchers_, &SplatFetcher::Stats::records);
    }
    std::uint64_t records_cancelled() const {
        return sum_of(fetchers_, &SplatFetcher::Stats::records_cancelled);
    }

private:
    void build_streams();
    void build_engines();
    void build_caches();
    void build_fetcher(ReuseCache* cache);
    void build_monitor(int engine, std::size_t listeners);
    void bind_cancel(int engine, std::size_t listener, FifoPort<TileNumber>& port);
    void build_pixel_buffer(int engine);
    void build_memory();
    /// Rings of splats into one engine, one for each of its fetchers.
    std::size_t inputs() const { return fetchers_.size() / parts_.engines; }
    void bind_inputs(FifoPort<SplatChunk>& in, std::size_t first) { in.bind(*splat_rings_[first]); }
    void bind_inputs(sc_core::sc_vector<FifoPort<SplatChunk>>& in, std::size_t first) {
        for (std::size_t i = 0; i < in.size(); ++i) {
            in[i].bind(*splat_rings_[first + i]);
        }
    }

    Parts parts_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;
    std::size_t connected_ = 0; // engines

    std::unique_ptr<TileFrontEnd> front_end_;
    std::unique_ptr<Process>
        nobody_; // writes cancellations that never come: a granted list is sorted to its end
    std::unique_ptr<TileGrants> grants_;
    NextUses next_uses_;
    std::vector<std::unique_ptr<ReuseCache>> caches_;
    std::vector<std::unique_ptr<SplatFetcher>> fetchers_;
    PixelBuffers pixel_buffers_;
    std::vector<std::unique_ptr<TileMonitor>> monitors_;
    FrameEnds frame_ends_;
    MemoryStreams streams_;

    Rings<SortedRun> sorted_rings_; // if tiles are not granted
    Rings<SplatChunk> splat_rings_;
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
};

} // namespace degs
