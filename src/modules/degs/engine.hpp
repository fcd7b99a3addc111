// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/degs/back_end.hpp"
#include "modules/kit/engine/frame_ends.hpp"
#include "modules/kit/engine/tile_grants.hpp"
#include "modules/kit/memory/memory_streams.hpp"

namespace degs {

/// The DeGS accelerator with its memory, composed from its blocks (paper, Fig. 4):
///
///   Tile Front End -> Splat Fetchers -> [Gaussian Buffer] -> Slicing Units -> [Span Buffer] ->
///   Span Units -> crossbar -> Issue Banks -> Packing Units -> [Packing Buffer] -> array slices ->
///   Pixel Buffer -> memory
///
/// There are two ways back: terminations to the Issue Banks, and tile cancellation to the fetchers.
/// With several tile streams (slicing.interleave) each has its own fetcher, Slicing Units, lanes of
/// the Span Buffer, queues of the crossbar and contexts of the Pixel Buffer; the Tile Dispatcher
/// hands out the tiles. With several clusters everything from the Splat Fetchers to the Pixel
/// Buffer is there as often, behind one front end and one memory.
class Degs : public RenderEngine {
public:
    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Degs(const sc_core::sc_module_name& name, const DegsConfig& config, const Timebase& time,
         RenderJob& job, const BuildOptions& options = {});

    std::size_t finished_tiles() const override;
    void collect(AcceleratorResult& result) const override;
    std::vector<BlockGroup> logged_blocks() const override;

    const DegsConfig& config() const { return config_; }
    const TileFrontEnd& front_end() const { return *front_end_; }
    const std::vector<std::unique_ptr<SplatFetcher>>& fetchers() const { return blocks_.fetchers; }
    const std::vector<std::unique_ptr<GaussianSlicingUnit>>& slicing() const {
        return blocks_.slicing;
    }
    const std::vector<std::unique_ptr<SpanStage>>& spans() const { return blocks_.spans; }
    const std::vector<std::unique_ptr<IssueBank>>& banks() const { return blocks_.banks; }
    const std::vector<std::unique_ptr<PackingUnit>>& packing() const { return blocks_.packing; }
    const std::vector<std::unique_ptr<ArraySlice>>& slices() const { return blocks_.slices; }
    const std::vector<std::unique_ptr<PixelBuffer>>& pixel_buffers() const {
        return blocks_.pixel_buffers;
    }
    /// Date at which the last pixel was in memory.
    Cycle finished() const;
    const std::vector<std::unique_ptr<TileMonitor>>& monitors() const { return blocks_.monitors; }
    const MemoryStreams& streams() const { return streams_; }
    /// Null if fetchers read by themselves.
    const SplatSupply* supply() const { return supply_.get(); }
    RingUse gaussian_buffer() const { return use_of(blocks_.gaussian_buffer); }
    RingUse span_buffer() const;
    RingUse crossbar() const;
    RingUse packing_buffer() const;

private:
    bool is_functional_first() const;
    void build_front_end();
    void build_supply();
    void build_back_ends();
    void build_memory();
    void collect_slots(AcceleratorResult& result) const;
    void collect_stages(AcceleratorResult& result) const;
    void collect_buffers(AcceleratorResult& result) const;
    void collect_activity(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;
    void collect_supply_laws(AcceleratorResult& result) const;
    void collect_idle_keys(AcceleratorResult& result) const;
    void collect_idle_streams(AcceleratorResult& result) const;
    void explain(AcceleratorResult& result) const;
    void explain_ports(AcceleratorResult& result) const;

    DegsConfig config_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;
    std::unique_ptr<FunctionalModel> functional_; // nullptr: tasks are blended when they execute

    std::unique_ptr<TileFrontEnd> front_end_;
    std::unique_ptr<SplatSupply> supply_;
    DegsBlocks blocks_;
    std::unique_ptr<TileGrants> grants_;                        // of streams
    std::vector<std::unique_ptr<sc_core::sc_module>> clusters_; // if there are several
    FrameEnds frame_ends_;
    MemoryStreams streams_;
};

} // namespace degs
