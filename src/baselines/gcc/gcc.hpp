// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "baselines/gcc/config.hpp"
#include "modules/collect.hpp"
#include "modules/front_end/frame_ends.hpp"
#include "modules/front_end/list_source.hpp"
#include "modules/memory_streams.hpp"

namespace degs::gcc {

/// The GCC accelerator with its memory (Pei et al., MICRO 2025; DeGS, Sec. II-B):
///
///   means -> Grouping (I) -> lists -> Projection Stage (II) -> Colour Stage (III) -> Window Array
///   (IV) -> image buffer -> memory
///
/// There are two ways back: ended blocks to Stage III, and cancelled views to Stages II and III. An
/// image that does not fit the image buffer is rendered view by view ("compatibility mode").
class Engine : public RenderEngine {
public:
    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
           RenderJob& job, const BuildOptions& options = {});

    std::size_t finished_tiles() const override { return image_buffers_[0]->stats().tiles; }
    void collect(AcceleratorResult& result) const override;

    const Config& config() const { return config_; }
    /// Stages I to III are null if the array is alone, the fetcher is null if it is not.
    const Grouping* grouping() const { return grouping_.get(); }
    const ProjectionStage* projection() const { return projection_.get(); }
    const ColourStage* colour() const { return colour_.get(); }
    const SplatFetcher* fetcher() const { return fetcher_.get(); }
    const WindowArray& array() const { return *array_; }
    const PixelBuffer& image_buffer() const { return *image_buffers_[0]; }
    const TileMonitor& monitor() const { return *monitor_; }
    const MemoryStreams& streams() const { return streams_; }

private:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    void build_array();
    void build_stages();
    void build_source();
    void build_memory();
    void bind_cancel(FifoPort<TileNumber>& listener);
    void collect_stages(AcceleratorResult& result) const;
    void collect_activity(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;
    void explain(AcceleratorResult& result) const;

    Config config_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;

    std::unique_ptr<Grouping> grouping_;
    std::unique_ptr<ProjectionStage> projection_;
    std::unique_ptr<ColourStage> colour_;
    std::unique_ptr<ListSource> source_;
    std::unique_ptr<SplatFetcher> fetcher_;
    std::unique_ptr<WindowArray> array_;
    PixelBuffers image_buffers_; // one
    std::unique_ptr<TileMonitor> monitor_;
    // A member, because SystemC 3.0 calls every vector once more at the end of elaboration.
    sc_core::sc_vector<FifoPort<std::uint32_t>> nobody_; // ports of stages that are not there
    FrameEnds frame_ends_;
    Rings<std::uint32_t> grouped_rings_;
    MemoryStreams streams_;
    bool gated_;
    std::size_t listeners_ = 0; // of cancellation, while wiring

    Rings<SplatChunk> projected_rings_, splat_rings_;
    Rings<SortedRun> sorted_rings_;
    Rings<BlockEnded> block_rings_;
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
};

} // namespace degs::gcc
