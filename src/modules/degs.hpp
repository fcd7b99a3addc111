// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/collect.hpp"
#include "modules/degs_config.hpp"
#include "modules/front_end/frame_ends.hpp"
#include "modules/front_end/tile_front_end.hpp"
#include "modules/memory_streams.hpp"

namespace degs {

/// The DeGS accelerator with its memory, composed from its blocks (paper, Fig. 4):
///
///   Tile Front End -> Splat Fetchers -> [Gaussian Buffer] -> Slicing Units -> [Span Buffer] ->
///   Span Units -> crossbar -> Issue Banks -> Packing Units -> [Packing Buffer] -> array slices ->
///   Pixel Buffer -> memory
///
/// There are two ways back: terminations to the Issue Banks, and tile cancellation to the fetchers.
class Degs : public RenderEngine {
public:
    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Degs(const sc_core::sc_module_name& name, const DegsConfig& config, const Timebase& time,
         RenderJob& job, const BuildOptions& options = {});

    std::size_t finished_tiles() const override;
    void collect(AcceleratorResult& result) const override;

    const DegsConfig& config() const { return config_; }
    const TileFrontEnd& front_end() const { return *front_end_; }
    const std::vector<std::unique_ptr<SplatFetcher>>& fetchers() const { return fetchers_; }
    const std::vector<std::unique_ptr<GaussianSlicingUnit>>& slicing() const { return slicing_; }
    const std::vector<std::unique_ptr<SpanUnit>>& spans() const { return spans_; }
    const std::vector<std::unique_ptr<IssueBank>>& banks() const { return banks_; }
    const std::vector<std::unique_ptr<PackingUnit>>& packing() const { return packing_; }
    const std::vector<std::unique_ptr<ArraySlice>>& slices() const { return slices_; }
    const std::vector<std::unique_ptr<PixelBuffer>>& pixel_buffers() const {
        return pixel_buffers_;
    }
    /// Date at which the last pixel was in memory.
    Cycle finished() const;
    const TileMonitor& monitor() const { return *monitor_; }
    const MemoryStreams& streams() const { return streams_; }
    RingUse gaussian_buffer() const { return use_of(gaussian_rings_); }
    RingUse span_buffer() const { return use_of(span_rings_); }
    RingUse crossbar() const { return use_of(crossbar_rings_); }
    RingUse packing_buffer() const { return use_of(packing_rings_); }

private:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    template <class T>
    DatedFifo<T>& ring(Rings<T>& rings, const char* name, int depth, int latency);
    template <class T>
    DatedFifo<T>& wire(Rings<T>& rings, const char* name, int latency);
    void build_front_end();
    void build_span_engine();
    void build_scheduler();
    void build_array();
    void build_pixel_buffer();
    void connect_region_feedback(int slice, int listeners);
    void build_memory();
    void collect_slots(AcceleratorResult& result) const;
    void collect_stages(AcceleratorResult& result) const;
    void collect_buffers(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;
    void explain(AcceleratorResult& result) const;

    DegsConfig config_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;

    std::unique_ptr<TileFrontEnd> front_end_;
    std::vector<std::unique_ptr<SplatFetcher>> fetchers_;
    std::vector<std::unique_ptr<GaussianSlicingUnit>> slicing_;
    std::vector<std::unique_ptr<SpanUnit>> spans_;
    std::vector<std::unique_ptr<IssueBank>> banks_;
    std::vector<std::unique_ptr<PackingUnit>> packing_;
    std::vector<std::unique_ptr<ArraySlice>> slices_;
    std::vector<std::unique_ptr<PixelBuffer>> pixel_buffers_; // one, or one per bank
    std::unique_ptr<TileMonitor> monitor_;
    FrameEnds frame_ends_;
    MemoryStreams streams_;

    Rings<SortedRun> sorted_rings_;
    Rings<SplatChunk> gaussian_rings_;
    Rings<RowItem> span_rings_;
    Rings<SpanItem> crossbar_rings_;
    Rings<TaskPacket> packing_rings_;
    Rings<Termination> termination_rings_;
    Rings<RegionEnded> region_rings_;
    std::vector<std::size_t> next_region_port_; // while wiring: per Slicing Unit
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
};

} // namespace degs
