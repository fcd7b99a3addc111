// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/front_end/list_changes.hpp"
#include "modules/kit/front_end/list_loader.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Puts the list of a tile in near-to-far order (paper Table I, "Sorting Unit"). Tiles go
/// round the units. Two overlapping steps: load the list, merge-sort it; a Splat Fetcher
/// takes it from there. Lists longer than the unit's share of the Gaussian Buffer take extra
/// merge passes through memory. Lists that are kept for the next frame have only their new entries
/// sorted and merged with the others, and are written back.
class SortingUnit : public sc_core::sc_module {
public:
    struct Config {
        int count = 4;          ///< units
        int keys_per_cycle = 4; ///< keys moved per cycle and pass
        int merge_ways = 16;    ///< fan-in of a pass: n keys take ceil(log_ways n) passes
        int lists_ahead = 1;    ///< loaded while one is sorted
        int memory_passes = 0;  ///< of every list, at least
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle sort_busy = 0;
        std::uint64_t keys = 0, memory_passes = 0;
        void describe(StatsVisitor& v) const {
            v.count("keys", keys, "keys", "List entries sorted.");
            v.count("memory_passes", memory_passes, "passes", "Passes of lists through memory.");
        }
    };

    FifoPort<std::uint32_t> start; ///< frame tokens from the binner
    FifoPort<SortedRun> sorted;    ///< to a Splat Fetcher; kNoTile at the end
    ListLoader loader;
    MemoryPort lists; ///< of passes through memory

    /// `sort_capacity`: keys that fit the unit's share of the Gaussian Buffer.
    SortingUnit(const sc_core::sc_module_name& name, const Config& config,
                const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                ListChanges& changes, TileNumber index, std::uint64_t sort_capacity);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void sort();
    std::uint64_t passes(std::uint64_t keys) const;
    /// Keys moved on the chip for a list, in all passes.
    std::uint64_t keys_moved(const JobTile& tile);

    Config config_;
    TrafficConfig traffic_;
    const RenderJob& job_;
    ListChanges& changes_;
    SorterTiles tiles_;
    std::uint64_t sort_capacity_;
    Process sorter_;
    DatedFifo<TileNumber> loaded_;
    Stats stats_;
};

} // namespace degs
