// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <systemc>

#include "modules/degs/config.hpp"
#include "modules/degs/functional/functional_model.hpp"
#include "modules/degs/span_engine/parameter_release.hpp"
#include "modules/kit/engine/collect.hpp"
#include "modules/kit/engine/tile_front_end.hpp"
#include "tlm/rings.hpp"

namespace degs {

/// The blocks of all back ends of a DeGS, back end after back end, and the rings between them.
struct DegsBlocks {
    template <class T>
    using Units = std::vector<std::unique_ptr<T>>;
    template <class T>
    using Rings = Units<DatedFifo<T>>;

    Units<SplatFetcher> fetchers; ///< one per Sorting Unit, or per stream
    Units<GaussianSlicingUnit> slicing;
    Units<ParameterRelease> releases;
    Units<SpanStage> spans;
    Units<IssueBank> banks;
    Units<PackingUnit> packing;
    Units<ArraySlice> slices;
    Units<PixelBuffer> pixel_buffers; ///< stream by stream; of each one, or one per bank
    Units<TileMonitor> monitors;      ///< one per stream

    Rings<SortedRun> sorted;
    Rings<SplatChunk> splat_requests; ///< to the Splat Supply
    Rings<SplatChunk> gaussian_buffer;
    Rings<RowItem> span_buffer;
    Rings<SpanItem> crossbar;
    Rings<TaskPacket> packing_buffer;
    Rings<Termination> terminations;
    Rings<RegionEnded> region_ended;
    Rings<SliceReport> tile_done, tile_state;
    Rings<ChunkSliced> sliced;
    Rings<RowCount> row_counts;
    Rings<RowSolved> solved;
    Rings<ChunkReleased> places;
    Rings<TileNumber> context_free, cancel;
};

/// A back end of DeGS: all blocks from the Splat Fetchers to the Pixel Buffers. It builds them,
/// connects them among themselves and with the front end, and leaves them in `DegsBlocks`.
class DegsBackEnd {
public:
    /// What all back ends share.
    struct Shared {
        const DegsConfig& config;
        const Timebase& time;
        RenderJob& job;
        TileFrontEnd& front_end;
        SplatSupply* supply;         ///< nullptr: fetchers read by themselves
        FunctionalModel* functional; ///< nullptr: tasks are blended when they execute
        const BuildOptions& options;
    };

    /// Builds the fetchers. The back end of this index keeps its tiles in its own contexts.
    DegsBackEnd(const Shared& shared, DegsBlocks& blocks, int index);
    /// Builds everything behind the fetchers.
    void build();

private:
    /// The units of one kind that belong to this back end.
    template <class T>
    class Own {
    public:
        explicit Own(std::vector<std::unique_ptr<T>>& all) : all_(all), first_(all.size()) {}
        std::size_t size() const { return all_.size() - first_; }
        T* operator[](std::size_t index) const { return all_[first_ + index].get(); }
        T& back() const { return *all_.back(); }
        T& add(std::unique_ptr<T> unit) {
            all_.push_back(std::move(unit));
            return *all_.back();
        }

    private:
        std::vector<std::unique_ptr<T>>& all_;
        std::size_t first_;
    };
    template <class T>
    using OwnRings = Own<DatedFifo<T>>;

    template <class T>
    DatedFifo<T>& ring(OwnRings<T>& rings, const char* name, int depth, int latency,
                       int release = 0) {
        return rings.add(std::make_unique<DatedFifo<T>>(numbered(name, rings.size()).c_str(), time_,
                                                        depth, latency, release));
    }
    template <class T>
    DatedFifo<T>& wire(OwnRings<T>& rings, const char* name, int latency) {
        return rings.add(std::make_unique<DatedFifo<T>>(numbered(name, rings.size()).c_str(), time_,
                                                        FifoBase::kWire, latency));
    }
    int fetchers_of_stream() const { return config_.fetchers() / config_.streams(); }
    int first_context() const { return index_ * config_.contexts(); }
    void build_fetchers();
    void connect_supply(int fetcher);
    FifoPort<SplatChunk>& splats_to(int slicer, int fetcher);
    FifoPort<ChunkReleased>& places_from(int slicer, int fetcher);
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

    const DegsConfig& config_;
    const Timebase& time_; // blocks refer to its clock
    RenderJob& job_;
    TileFrontEnd& front_end_;
    SplatSupply* supply_;
    FunctionalModel* functional_;
    BuildOptions options_;
    int index_;

    Own<SplatFetcher> fetchers_;
    Own<GaussianSlicingUnit> slicing_;
    Own<ParameterRelease> releases_;
    Own<SpanStage> spans_;
    Own<IssueBank> banks_;
    Own<PackingUnit> packing_;
    Own<ArraySlice> slices_;
    Own<PixelBuffer> pixel_buffers_;
    Own<TileMonitor> monitors_;
    OwnRings<SortedRun> sorted_rings_;
    OwnRings<SplatChunk> request_rings_, gaussian_rings_;
    OwnRings<RowItem> span_rings_;
    OwnRings<SpanItem> crossbar_rings_;
    OwnRings<TaskPacket> packing_rings_;
    OwnRings<Termination> termination_rings_;
    OwnRings<RegionEnded> region_rings_;
    OwnRings<SliceReport> done_rings_, state_rings_;
    OwnRings<ChunkSliced> sliced_rings_;
    OwnRings<RowCount> row_count_rings_;
    OwnRings<RowSolved> solved_rings_;
    OwnRings<ChunkReleased> place_rings_;
    OwnRings<TileNumber> context_rings_, cancel_rings_;
    // While wiring: the next port of each Slicing Unit and of each module of Span Units.
    std::vector<std::size_t> next_region_port_, next_span_port_;
};

} // namespace degs
