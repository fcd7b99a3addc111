// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/collect.hpp"
#include "modules/degs_config.hpp"
#include "modules/drawing/tile_drawing.hpp"
#include "modules/front_end/frame_ends.hpp"
#include "modules/front_end/tile_front_end.hpp"
#include "modules/front_end/tile_grants.hpp"
#include "modules/memory_streams.hpp"
#include "modules/span_engine/parameter_release.hpp"

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
/// hands out the tiles.
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
    const std::vector<std::unique_ptr<SpanStage>>& spans() const { return spans_; }
    const std::vector<std::unique_ptr<IssueBank>>& banks() const { return banks_; }
    const std::vector<std::unique_ptr<PackingUnit>>& packing() const { return packing_; }
    const std::vector<std::unique_ptr<ArraySlice>>& slices() const { return slices_; }
    const std::vector<std::unique_ptr<PixelBuffer>>& pixel_buffers() const {
        return pixel_buffers_;
    }
    /// Date at which the last pixel was in memory.
    Cycle finished() const;
    const std::vector<std::unique_ptr<TileMonitor>>& monitors() const { return monitors_; }
    const MemoryStreams& streams() const { return streams_; }
    RingUse gaussian_buffer() const { return use_of(gaussian_rings_); }
    RingUse span_buffer() const { return use_of(span_rings_); }
    RingUse crossbar() const;
    RingUse packing_buffer() const;

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
    bool draws_ahead() const;
    void build_front_end();
    void build_fetchers();
    void build_slicing();
    void build_spans();
    void build_parameter_release();
    std::unique_ptr<SpanStage> make_span_module(int index);
    void build_scheduler();
    void connect_crossbar(int bank);
    void build_array();
    void connect_slice(int bank);
    void build_pixel_buffers();
    void connect_region_feedback(int slice);
    void build_memory();
    void collect_slots(AcceleratorResult& result) const;
    void collect_stages(AcceleratorResult& result) const;
    void collect_buffers(AcceleratorResult& result) const;
    void collect_activity(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;
    void explain(AcceleratorResult& result) const;
    void explain_ports(AcceleratorResult& result) const;

    DegsConfig config_;
    Timebase time_;
    RenderJob& job_;
    BuildOptions options_;
    std::unique_ptr<TileDrawing> drawing_; // nullptr: tasks are blended when they execute

    std::unique_ptr<TileFrontEnd> front_end_;
    std::vector<std::unique_ptr<SplatFetcher>> fetchers_; // one per Sorting Unit, or per stream
    std::unique_ptr<TileGrants> grants_;                  // of streams
    std::vector<std::unique_ptr<GaussianSlicingUnit>> slicing_;
    std::vector<std::unique_ptr<ParameterRelease>> releases_;
    std::vector<std::unique_ptr<SpanStage>> spans_;
    std::vector<std::unique_ptr<IssueBank>> banks_;
    std::vector<std::unique_ptr<PackingUnit>> packing_;
    std::vector<std::unique_ptr<ArraySlice>> slices_;
    /// Stream by stream; of each one, or one per bank.
    std::vector<std::unique_ptr<PixelBuffer>> pixel_buffers_;
    std::vector<std::unique_ptr<TileMonitor>> monitors_; // one per stream
    FrameEnds frame_ends_;
    MemoryStreams streams_;

    Rings<SortedRun> sorted_rings_;
    Rings<SplatChunk> gaussian_rings_;
    Rings<RowItem> span_rings_;
    Rings<SpanItem> crossbar_rings_;
    Rings<TaskPacket> packing_rings_;
    Rings<Termination> termination_rings_;
    Rings<RegionEnded> region_rings_;
    // While wiring: the next port of each Slicing Unit and of each module of Span Units.
    std::vector<std::size_t> next_region_port_, next_span_port_;
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<ChunkSliced> sliced_rings_;
    Rings<RowCount> row_count_rings_;
    Rings<RowSolved> solved_rings_;
    Rings<ChunkReleased> place_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
};

} // namespace degs
