// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "baselines/gbu_config.hpp"
#include "modules/collect.hpp"
#include "modules/front_end/frame_ends.hpp"
#include "modules/front_end/reuse_cache.hpp"
#include "modules/front_end/tile_front_end.hpp"
#include "modules/front_end/tile_grants.hpp"
#include "modules/memory_streams.hpp"

namespace degs {

/// The standalone GBU with its memory:
///
///   Tile Front End -> List Collectors -> Tile Dispatcher -> per engine: Splat Fetcher with reuse
///   cache -> tile engine -> Pixel Buffer -> memory
///
/// Engines ask for a tile when their fetcher has handed on the one before.
class Gbu : public RenderEngine {
public:
    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Gbu(const sc_core::sc_module_name& name, const GbuConfig& config, const Timebase& time,
        RenderJob& job, const BuildOptions& options = {});

    std::size_t finished_tiles() const override;
    void collect(AcceleratorResult& result) const override;

    const GbuConfig& config() const { return config_; }
    const TileFrontEnd& front_end() const { return *front_end_; }
    const TileDispatcher& dispatcher() const { return grants_->dispatcher(); }
    const std::vector<std::unique_ptr<SplatFetcher>>& fetchers() const { return fetchers_; }
    const std::vector<std::unique_ptr<ReuseCache>>& caches() const { return caches_; }
    const std::vector<std::unique_ptr<TileEngine>>& engines() const { return engines_; }
    const std::vector<std::unique_ptr<PixelBuffer>>& pixel_buffers() const {
        return pixel_buffers_;
    }
    const std::vector<std::unique_ptr<TileMonitor>>& monitors() const { return monitors_; }
    const MemoryStreams& streams() const { return streams_; }
    RingUse splat_buffer() const { return use_of(splat_rings_); }

private:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    template <class T>
    DatedFifo<T>& ring(Rings<T>& rings, const char* name, int depth, int latency) {
        return add_ring(rings, name, time_, depth, latency);
    }
    template <class T>
    DatedFifo<T>& wire(Rings<T>& rings, const char* name, int latency) {
        return add_wire(rings, name, time_, latency);
    }
    void build_front_end();
    void build_caches();
    void build_engine(int index);
    void build_pixel_buffer(int index);
    void build_memory();
    void collect_slots(AcceleratorResult& result) const;
    void collect_stages(AcceleratorResult& result) const;
    void collect_buffers(AcceleratorResult& result) const;
    void collect_activity(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;

    GbuConfig config_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;

    std::unique_ptr<TileFrontEnd> front_end_;
    Process nobody_; // writes cancellations that never come: a granted list is sorted to its end
    std::unique_ptr<TileGrants> grants_;
    NextUses next_uses_;
    std::vector<std::unique_ptr<ReuseCache>> caches_;
    std::vector<std::unique_ptr<SplatFetcher>> fetchers_;
    std::vector<std::unique_ptr<TileEngine>> engines_;
    std::vector<std::unique_ptr<PixelBuffer>> pixel_buffers_;
    std::vector<std::unique_ptr<TileMonitor>> monitors_;
    FrameEnds frame_ends_;
    MemoryStreams streams_;

    Rings<SplatChunk> splat_rings_;
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
};

} // namespace degs
