// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/degs_config.hpp"

namespace degs {

/// The DeGS accelerator with its memory, composed from its blocks (paper, Fig. 4):
///
///   memory -> Projection Units -> Tile Binner -> memory -> Sorting Units -> [Gaussian Buffer] ->
///   Slicing Units -> [Span Buffer] -> Span Units -> crossbar -> Issue Banks -> Packing Units ->
///   [Packing Buffer] -> array slices -> Pixel Buffer -> memory
///
/// with two ways back: terminations to the Issue Banks, tile cancellation to the fetchers.
class Degs : public sc_core::sc_module {
public:
    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Degs(const sc_core::sc_module_name& name, const DegsConfig& config, const Timebase& time,
         RenderJob& job);

    const DegsConfig& config() const { return config_; }
    const std::vector<std::unique_ptr<ProjectionUnit>>& projection() const { return projection_; }
    const TileBinner& binner() const { return *binner_; }
    const std::vector<std::unique_ptr<SortingUnit>>& sorting() const { return sorting_; }
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
    const Memory& memory() const { return *memory_; }
    /// Statistics of the rings that stand for a buffer of Table I, in the order given.
    struct RingUse {
        std::size_t depth = 0, high_water = 0;
        std::uint64_t items = 0;
        Cycle full_cycles = 0, empty_cycles = 0, occupied_cycles = 0;
    };
    RingUse gaussian_buffer() const;
    RingUse span_buffer() const;
    RingUse crossbar() const;
    RingUse packing_buffer() const;

    /// What a memory initiator reads or writes, for reports; index = Memory initiator.
    const std::vector<const char*>& stream_of_initiator() const { return streams_; }

private:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    template <class T>
    DatedFifo<T>& ring(Rings<T>& rings, const char* name, int depth, int latency);
    void build_front_end();
    void build_span_engine();
    void build_scheduler();
    void build_array();
    void build_pixel_buffer();
    void connect_region_feedback(int slice, int listeners);
    void build_memory();
    void connect_memory(MemoryPort& port, const char* stream);

    DegsConfig config_;
    Timebase time_;
    RenderJob& job_;

    std::vector<std::unique_ptr<ProjectionUnit>> projection_;
    std::unique_ptr<TileBinner> binner_;
    std::vector<std::unique_ptr<SortingUnit>> sorting_;
    std::vector<std::unique_ptr<GaussianSlicingUnit>> slicing_;
    std::vector<std::unique_ptr<SpanUnit>> spans_;
    std::vector<std::unique_ptr<IssueBank>> banks_;
    std::vector<std::unique_ptr<PackingUnit>> packing_;
    std::vector<std::unique_ptr<ArraySlice>> slices_;
    std::vector<std::unique_ptr<PixelBuffer>> pixel_buffers_; // one, or one per bank
    std::unique_ptr<TileMonitor> monitor_;
    std::unique_ptr<Memory> memory_;

    Rings<ProjectedChunk> projected_;
    Rings<std::uint32_t> frames_;
    Rings<SplatChunk> gaussian_rings_;
    Rings<RowItem> span_rings_;
    Rings<SpanItem> crossbar_rings_;
    Rings<TaskPacket> packing_rings_;
    Rings<Termination> termination_rings_;
    Rings<RegionEnded> region_rings_;
    std::vector<std::size_t> next_region_port_; // while wiring: per Slicing Unit
    Rings<SliceReport> done_rings_, state_rings_;
    Rings<TileNumber> context_rings_, cancel_rings_;
    std::vector<MemoryPort*> ports_;
    std::vector<const char*> streams_;
};

} // namespace degs
