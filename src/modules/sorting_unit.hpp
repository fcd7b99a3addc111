// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/render_job.hpp"
#include "modules/traffic.hpp"
#include "tlm/dated_fifo.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Puts the list of a tile in near-to-far order and streams its splat records into the Gaussian
/// Buffer (paper Table I, "Sorting Unit"). Tiles go round the units. Three overlapping steps: load
/// the list, merge-sort it, fetch records. Lists longer than the unit's share of the Gaussian
/// Buffer take extra merge passes through memory. Fetching stops when the tile is cancelled.
class SortingUnit : public sc_core::sc_module {
public:
    struct Config {
        int count = 4;            ///< units
        int keys_per_cycle = 4;   ///< keys moved per cycle and pass
        int merge_ways = 16;      ///< fan-in of a pass: n keys take ceil(log_ways n) passes
        int chunk = 16;           ///< splat records per request and hand-over
        int chunks_in_flight = 8; ///< record requests outstanding per unit
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle sort_busy = 0;
        std::uint64_t keys = 0, memory_passes = 0;
        std::uint64_t records = 0, records_cancelled = 0;
    };

    FifoPort<std::uint32_t> start;                ///< frame tokens from the binner
    FifoPort<TileNumber> cancel;                  ///< from the Tile Monitor
    sc_core::sc_vector<FifoPort<SplatChunk>> out; ///< Gaussian Buffer, one view per Slicing Unit
    MemoryPort lists;
    MemoryPort records;

    /// `sort_capacity`: keys that fit the unit's share of the Gaussian Buffer.
    SortingUnit(const sc_core::sc_module_name& name, const Config& config,
                const TrafficConfig& traffic, const Timebase& time, const RenderJob& job, int index,
                std::size_t outputs, std::uint64_t sort_capacity);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void load();
    void sort();
    void fetch();
    void fetch_tile(TileNumber number);
    bool cancelled(TileNumber number);
    std::uint64_t passes(std::uint64_t keys) const;

    Config config_;
    TrafficConfig traffic_;
    const RenderJob& job_;
    std::size_t index_;
    std::uint64_t sort_capacity_;
    Process loader_, sorter_, fetcher_;
    DatedFifo<TileNumber> loaded_;
    DatedFifo<TileNumber> sorted_;
    TileNumber cancelled_before_ = 0; // tiles below this number are cancelled or over
    std::vector<Cycle> answered_;     // ring of completion dates of the latest record requests
    std::uint64_t requests_ = 0;
    Stats stats_;
};

} // namespace degs
