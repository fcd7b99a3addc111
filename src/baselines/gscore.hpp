// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "baselines/gscore_config.hpp"
#include "modules/collect.hpp"
#include "modules/frame_gate.hpp"
#include "modules/memory_streams.hpp"
#include "modules/tile_front_end.hpp"

namespace degs {

/// GSCore with its memory (Lee et al., ASPLOS 2024; the paper's Sec. II-B and Table I):
///
///   Tile Front End with Hierarchical Sorters -> Splat Fetchers -> [buffer] -> Lockstep Array ->
///   Pixel Buffer -> memory
///
/// and one way back: a tile whose pixels have all ended is cancelled, neither fetched nor sorted
/// any further.
class Gscore : public RenderEngine {
public:
    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Gscore(const sc_core::sc_module_name& name, const GscoreConfig& config, const Timebase& time,
           RenderJob& job, const BuildOptions& options = {});

    std::size_t finished_tiles() const override;
    void collect(AcceleratorResult& result) const override;

    const GscoreConfig& config() const { return config_; }
    const LockstepArray& array() const { return *array_; }

private:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    void build_front_end();
    void build_array();
    void build_frame_gate();
    void build_memory();
    void collect_stages(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;
    void explain(AcceleratorResult& result) const;

    GscoreConfig config_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;

    std::unique_ptr<TileFrontEnd> front_end_;
    std::vector<std::unique_ptr<SplatFetcher>> fetchers_;
    std::unique_ptr<LockstepArray> array_;
    PixelBuffers pixel_buffers_; // one
    std::unique_ptr<TileMonitor> monitor_;
    std::unique_ptr<FrameGate> frame_gate_;
    MemoryStreams streams_;

    Rings<SortedRun> sorted_rings_;
    Rings<SplatChunk> splat_rings_;
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
    Rings<std::uint32_t> frame_rings_;
};

} // namespace degs
