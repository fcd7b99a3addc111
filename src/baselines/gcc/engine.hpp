// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <systemc>

#include "baselines/gcc/config.hpp"
#include "modules/kit/engine/collect.hpp"
#include "modules/kit/engine/frame_ends.hpp"
#include "modules/kit/front_end/list_source.hpp"
#include "modules/kit/front_end/tile_dispatcher.hpp"
#include "modules/kit/memory/memory_streams.hpp"
#include "tlm/rings.hpp"

namespace degs::gcc {

/// The GCC accelerator with its memory (Pei et al., MICRO 2025; DeGS, Sec. II-B):
///
///   means -> Grouping (I) -> lists -> Projection Stage (II) -> Colour Stage (III) -> Window Array
///   (IV) -> image buffer -> memory
///
/// There are two ways back: ended blocks to Stage III, and cancelled views to Stages II and III. An
/// image that does not fit the image buffer is rendered view by view ("compatibility mode"). With
/// several clusters each of them has Stages II to IV and an image buffer, for views that the Tile
/// Dispatcher grants.
class Engine : public RenderEngine {
public:
    template <class Unit>
    using Units = std::vector<std::unique_ptr<Unit>>;

    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
           RenderJob& job, const BuildOptions& options = {});

    std::size_t finished_tiles() const override {
        return sum_of(image_buffers_, &PixelBuffer::Stats::tiles);
    }
    void collect(AcceleratorResult& result) const override;

    const Config& config() const { return config_; }
    /// Null if the array is alone.
    const Grouping* grouping() const { return grouping_.get(); }
    // One for each cluster; there are no stages if the array is alone, and no fetchers if it is
    // not.
    const Units<ProjectionStage>& projection() const { return projection_; }
    const Units<ColourStage>& colour() const { return colour_; }
    const Units<SplatFetcher>& fetchers() const { return fetchers_; }
    const Units<WindowArray>& arrays() const { return arrays_; }
    const PixelBuffers& image_buffers() const { return image_buffers_; }
    const Units<TileMonitor>& monitors() const { return monitors_; }
    const MemoryStreams& streams() const { return streams_; }

private:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    void build_array(int cluster);
    void build_stages();
    void build_stages_of(int cluster);
    void build_source();
    void build_fetcher(int cluster);
    void build_grants();
    void build_memory();
    bool granted() const { return config_.clusters > 1; }
    std::string name_of(const char* block, int cluster) const {
        return granted() ? numbered(block, cluster) : block;
    }
    void bind_cancel(int cluster, std::size_t listener, FifoPort<TileNumber>& port);
    void collect_slots(AcceleratorResult& result) const;
    void collect_stages(AcceleratorResult& result) const;
    void collect_activity(AcceleratorResult& result) const;
    void collect_preparation(AcceleratorResult& result) const;
    void collect_idle_keys(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;
    void explain(AcceleratorResult& result) const;

    Config config_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;

    std::unique_ptr<Grouping> grouping_;
    std::unique_ptr<ListSource> source_;         // of the array alone, and of grants
    std::unique_ptr<TileDispatcher> dispatcher_; // of several clusters
    Units<ProjectionStage> projection_;
    Units<ColourStage> colour_;
    Units<SplatFetcher> fetchers_;
    Units<WindowArray> arrays_;
    PixelBuffers image_buffers_;
    Units<TileMonitor> monitors_;
    // A member, because SystemC 3.0 calls every vector once more at the end of elaboration.
    sc_core::sc_vector<FifoPort<std::uint32_t>> nobody_; // ports of stages that are not there
    FrameEnds frame_ends_;
    Rings<std::uint32_t> grouped_rings_;
    MemoryStreams streams_;
    bool gated_;

    Rings<SplatChunk> projected_rings_, splat_rings_;
    Rings<SortedRun> sorted_rings_, grant_rings_;
    Rings<TileRequest> request_rings_;
    Rings<BlockEnded> block_rings_;
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
};

} // namespace degs::gcc
