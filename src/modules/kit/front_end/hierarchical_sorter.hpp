// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "config/config.hpp"
#include "modules/kit/front_end/list_changes.hpp"
#include "modules/kit/front_end/list_loader.hpp"
#include "stats/statistics.hpp"

namespace degs {

/// Sorts the list of a tile in two steps (Lee et al., ASPLOS 2024): a coarse partition by pivots
/// into chunks that are in depth order among themselves, then each chunk exactly, just before it is
/// rendered. Chunks of a tile that has been cancelled are never sorted. Tiles go round the units;
/// loading, the coarse step and the fine step overlap.
///
/// A coarse level halves the partitions and moves every key once. While partitions are
/// longer than the unit's buffer, levels go through memory, and each chunk is read once
/// more before its fine step.
class HierarchicalSorter : public sc_core::sc_module {
public:
    struct Config {
        int count = 4;               ///< units
        int chunk = 256;             ///< keys that are sorted exactly at a time
        int keys_per_cycle = 2;      ///< moved per cycle and coarse level
        int fine_cycles_per_key = 2; ///< of the exact step
        int lists_ahead = 1;         ///< of each step
        int memory_levels = 0;       ///< coarse levels through memory, at least
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle coarse_busy = 0, fine_busy = 0;
        std::uint64_t keys = 0, keys_sorted = 0, keys_cancelled = 0;
        std::uint64_t memory_levels = 0;
        void describe(StatsVisitor& v) const {
            v.count("keys", keys, "keys", "List entries partitioned by the coarse step.");
            v.count("keys_sorted", keys_sorted, "keys", "List entries sorted by the exact step.");
            v.count("keys_cancelled", keys_cancelled, "keys",
                    "List entries not sorted because their tile was finished.");
            v.count("coarse_cycles", coarse_busy, "cycles", "Cycles of the coarse step.");
            v.count("fine_cycles", fine_busy, "cycles", "Cycles of the exact step.");
            v.count("memory_levels", memory_levels, "levels",
                    "Coarse levels that went through memory.");
        }
    };

    FifoPort<std::uint32_t> start; ///< frame tokens from the binner
    FifoPort<TileNumber> cancel;   ///< from the Tile Monitor
    FifoPort<SortedRun> sorted;    ///< to a Splat Fetcher, a run per chunk; kNoTile at the end
    ListLoader loader;
    MemoryPort lists;  ///< of coarse levels through memory
    MemoryPort chunks; ///< of long lists, before the exact step

    /// `capacity`: keys that fit the unit's share of the buffer.
    HierarchicalSorter(const sc_core::sc_module_name& name, const Config& config,
                       const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                       ListChanges& changes, TileNumber index, std::uint64_t capacity);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void coarse();
    void fine();
    void sort_chunks(TileNumber number);
    bool cancelled(TileNumber number);
    /// Coarse levels of a list that go through memory.
    std::uint64_t levels_outside(const JobTile& tile) const;
    bool through_memory(const JobTile& tile) const { return levels_outside(tile) != 0; }

    Config config_;
    TrafficConfig traffic_;
    const RenderJob& job_;
    ListChanges& changes_;
    SorterTiles of_coarse_, of_fine_;
    std::uint64_t capacity_;
    Process partitioner_, sorter_;
    DatedFifo<TileNumber> loaded_, partitioned_;
    TileNumber cancelled_before_ = 0; // tiles below this number are cancelled or over
    Stats stats_;
};

} // namespace degs
