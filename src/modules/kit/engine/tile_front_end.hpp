// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/kit/front_end/hierarchical_sorter.hpp"
#include "modules/kit/front_end/list_source.hpp"
#include "modules/kit/front_end/projection_unit.hpp"
#include "modules/kit/front_end/sorting_unit.hpp"
#include "modules/kit/front_end/splat_fetcher.hpp"
#include "modules/kit/front_end/tile_binner.hpp"
#include "modules/kit/memory/memory_streams.hpp"

namespace degs {

/// Everything before rasterisation in accelerators that work tile by tile:
///
///   memory -> Projection Units -> Tile Binner -> memory -> Sorting Units -> sorted lists
///
/// The list of tile t leaves through port t modulo the number of Sorting Units, or of Hierarchical
/// Sorters in their place.
class TileFrontEnd : public sc_core::sc_module {
public:
    struct Config {
        ProjectionUnit::Config projection;
        TileBinner::Config binning;
        SortingUnit::Config sorting;
        HierarchicalSorter::Config hierarchical; ///< instead of `sorting`, if on_demand
        bool on_demand = false;
        TrafficConfig traffic;
        std::uint64_t sort_capacity = 0; ///< keys that fit the buffer share of one Sorting Unit
        int frames_in_flight = 1;        ///< frame f + this starts when frame f has been written
        bool instant = false;            ///< Array alone: a List Source for each Sorting Unit
        /// Sorters of either kind, or List Sources.
        int sorters() const { return on_demand ? hierarchical.count : sorting.count; }
    };

    sc_core::sc_vector<FifoPort<SortedRun>> sorted;
    /// From the Tile Monitor, one per Hierarchical Sorter; empty without.
    sc_core::sc_vector<FifoPort<TileNumber>> cancel;
    /// Numbers of finished frames, one per Projection Unit; empty unless gated().
    sc_core::sc_vector<FifoPort<std::uint32_t>> frame_free;
    /// Numbers of frames whose lists are complete, for the Background Writer; empty if instant.
    sc_core::sc_vector<FifoPort<std::uint32_t>> listed;

    TileFrontEnd(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
                 const RenderJob& job);

    /// True if frames have to wait for each other; frame_free must then be connected.
    static bool gated(const Config& config, const RenderJob& job) {
        return !config.instant && job.has_more_frames_than(config.frames_in_flight);
    }
    /// Connects the memory ports, also those of the fetchers behind it.
    void connect_memory(MemoryStreams& streams,
                        const std::vector<std::unique_ptr<SplatFetcher>>& fetchers);
    /// Adds the stages, their activity and the dates at which lists were complete.
    void collect(AcceleratorResult& result) const;
    /// List entries read from and written to the lists on the chip: each once per step of sorting.
    std::uint64_t keys_moved() const;

    const std::vector<std::unique_ptr<ProjectionUnit>>& projection() const { return projection_; }
    /// Null if instant.
    const TileBinner* binner() const { return binner_.get(); }
    const std::vector<std::unique_ptr<SortingUnit>>& sorting() const { return sorting_; }
    const std::vector<std::unique_ptr<HierarchicalSorter>>& hierarchical() const {
        return hierarchical_;
    }

private:
    void build_sources(const Timebase& time, const RenderJob& job);
    void build_units(const Config& config, const Timebase& time, const RenderJob& job);
    void build_sorter(TileNumber index, const Config& config, const Timebase& time,
                      const RenderJob& job, DatedFifo<std::uint32_t>& frames);

    std::vector<std::unique_ptr<ListSource>> sources_;
    std::vector<std::unique_ptr<ProjectionUnit>> projection_;
    std::unique_ptr<ListChanges> changes_;
    std::unique_ptr<TileBinner> binner_;
    std::vector<std::unique_ptr<SortingUnit>> sorting_;
    std::vector<std::unique_ptr<HierarchicalSorter>> hierarchical_;
    std::vector<std::unique_ptr<DatedFifo<ProjectedChunk>>> projected_;
    std::vector<std::unique_ptr<DatedFifo<std::uint32_t>>> frames_;
};

} // namespace degs
