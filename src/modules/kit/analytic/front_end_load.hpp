// SPDX-License-Identifier: Apache-2.0
// The front end of accelerators that work tile by tile, as cycles: projection, binning, sorting and
// fetching, each at its rate.
#pragma once

#include <cstdint>

#include "modules/kit/accelerator/analytic_model.hpp"
#include "modules/kit/config/main_memory_config.hpp"
#include "modules/kit/front_end/hierarchical_sorter.hpp"
#include "modules/kit/front_end/projection_unit.hpp"
#include "modules/kit/front_end/sorting_unit.hpp"
#include "modules/kit/front_end/splat_fetcher.hpp"
#include "modules/kit/front_end/tile_binner.hpp"
#include "modules/kit/job/traffic.hpp"

namespace degs {

/// Memory as a rate and a latency, which is what `memory.model: bus` is. Refreshes, activations and
/// turnarounds leave a share of the bus of LPDDR5, more of it to the long streams before the first
/// tile, and a read waits for others as long as a read from a closed bank takes; all shares are
/// measured (docs/analytic.md).
struct MemoryRate {
    static constexpr double kLpddr5Share = 0.55, kLpddr5Streams = 0.82, kLpddr5Waiting = 2;
    double bytes_per_cycle = 0, latency = 0; ///< latency in cycles
    double streaming = 1;                    ///< rate of long streams over bytes_per_cycle
    MemoryRate(const MainMemoryConfig& memory, double clock_ghz)
        : bytes_per_cycle(share(memory) * memory.peak_gb_per_s() / clock_ghz),
          latency(latency_ns(memory) * clock_ghz),
          streaming(memory.model == MemoryModel::Lpddr5 ? kLpddr5Streams / kLpddr5Share : 1) {}
    static double share(const MainMemoryConfig& memory) {
        return memory.model == MemoryModel::Lpddr5 ? kLpddr5Share : 1;
    }
    static double latency_ns(const MainMemoryConfig& memory) {
        const dram::Timing& timing = memory.lpddr5.timing;
        return memory.model == MemoryModel::Lpddr5
                   ? kLpddr5Waiting * timing.ck_ns() * (timing.rcd + timing.read_latency())
                   : memory.latency_ns;
    }
    double cycles(double bytes) const { return bytes / bytes_per_cycle; }
    double stream_cycles(double bytes) const { return cycles(bytes) / streaming; }
    /// What writing takes of memory, the unit with that number, and of nothing else.
    TileCycles writes(double bytes, std::size_t unit) const {
        TileCycles written;
        written.bytes = bytes;
        written.written = bytes;
        written.busy[unit] = cycles(bytes);
        return written;
    }
};

/// Bytes that a record of `record` bytes moves if it is read alone, in whole bursts of `burst`
/// bytes, on average over the places at which records of this length lie.
double scattered_bytes(int record, int burst);

/// Kinds of units of the front end; those of an array follow.
enum FrontEndUnit : std::size_t { kProjectionUnits, kSortingUnits, kArrayUnits };

/// What a Pixel Buffer does: a read per task, a write per fragment, and a read per pixel at the end
/// of a tile. A pixel of a splat takes `slots_per_fragment` slots.
cost::Activity pixel_activity(const TileCycles& tiles, double pixel_bytes,
                              int slots_per_fragment = 1);

/// Bytes of list entries and of ends of lists, and cycles of the binner for them.
struct ListWritingLoad {
    double bytes = 0, cycles = 0;
    double sram_bytes = 0; ///< read and written
};
ListWritingLoad list_writing(const FrameWorkload& frame, const TrafficConfig& traffic,
                             const TileBinner::Config& binning);

class FrontEndLoad {
public:
    TrafficConfig traffic;
    ProjectionUnit::Config projection;
    TileBinner::Config binning;
    SplatFetcher::Config fetching;
    std::uint64_t places = 0;        ///< for splats before the array, of one fetcher
    std::uint64_t sort_capacity = 0; ///< keys
    MemoryRate memory;

    explicit FrontEndLoad(const MemoryRate& rate) : memory(rate) {}

    PreparationCycles preparation(const FrameWorkload& frame, std::size_t memory_unit) const;
    /// Cycles from the request of a chunk of splats to its last byte.
    double cycles_per_chunk() const;
    double chunk_bytes() const;
    /// Cycles of an access to `entries` of a list that somebody waits for.
    double list_access_cycles(double entries) const {
        return memory.latency + memory.cycles(entries * traffic.list_entry_bytes);
    }
    /// Cycles in which a fetcher has the first `walked` splats of a list come from memory.
    double fetch_cycles(double walked) const;
    /// Bytes of a tile's list, which passes through memory `outside` times, and of its pixels; and
    /// those of them that are written.
    double tile_bytes(const CoarseTile& tile, double outside) const;
    double bytes_written(const CoarseTile& tile, double outside) const;
    double record_bytes() const; ///< of a splat that is fetched
    /// Splats of a list that are fetched if its first `walked` are needed. A fetcher has always
    /// asked for others, and fills its places with more of them as far as memory, of which it has
    /// one share in `fetchers`, is faster than the array, which takes `array` cycles for the tile.
    double fetched(const CoarseTile& tile, double walked, double array, double fetchers) const;
    /// What each block of the front end in the bill of materials does.
    std::vector<cost::Activity> activity(const PreparationCycles& before,
                                         const TileCycles& tiles) const;
};

/// A model with such a front end. Its units begin with those of FrontEndUnit and end with memory.
class FrontEndModel : public AnalyticModel {
public:
    PreparationCycles preparation(const FrameWorkload& frame) const override {
        return front_.preparation(frame, memory_unit_);
    }
    Places places() const override {
        const auto chunk = static_cast<std::uint64_t>(front_.fetching.chunk);
        return {static_cast<std::size_t>(front_.places / chunk), static_cast<double>(chunk)};
    }
    double memory_latency() const override { return front_.memory.latency; }
    TileCycles background(double pixels) const override {
        return front_.memory.writes(pixels * front_.traffic.pixel_bytes, memory_unit_);
    }
    const FrontEndLoad& front() const { return front_; }
    const MainMemoryConfig& main_memory() const override { return main_memory_; }
    /// What a tile takes of the front end and of memory if the first `walked` splats of its list
    /// are needed and the array works on them for `array` cycles; these are left to the model.
    TileCycles front_end_cycles(const CoarseTile& tile, double walked, double array) const {
        TileCycles cycles;
        cycles.walked = walked;
        cycles.fragments = tile.fragments();
        const SortCycles sorted = sort_cycles(tile.entries(), walked);
        cycles.fetched = front_.fetched(tile, walked, array, engines());
        cycles.bytes =
            front_.tile_bytes(tile, sorted.outside) + cycles.fetched * front_.record_bytes();
        cycles.written = front_.bytes_written(tile, sorted.outside);
        cycles.sorting = sorted.busy;
        constexpr int kReadAndWritten = 2;
        cycles.keys = kReadAndWritten * sorted.keys;
        cycles.busy[kSortingUnits] = sorted.busy / sorters();
        cycles.busy[memory_unit_] = front_.memory.cycles(cycles.bytes);
        cycles.time = front_.fetch_cycles(walked);
        return cycles;
    }

protected:
    /// `chunks` of splats are fetched ahead of the array.
    template <class Config>
    FrontEndModel(const Config& config, int chunks, std::size_t memory_unit)
        : front_(MemoryRate(config.memory, config.clock_ghz)), main_memory_(config.memory),
          memory_unit_(memory_unit) {
        front_.traffic = config.traffic;
        front_.projection = config.projection;
        front_.binning = config.binning;
        front_.fetching = config.fetching;
        front_.places = std::uint64_t{1} * chunks * config.fetching.chunk;
        front_.sort_capacity = config.sort_capacity();
    }

private:
    FrontEndLoad front_;
    MainMemoryConfig main_memory_;
    std::size_t memory_unit_;
};

/// Cycles of one sorter of `front` for a list of `entries`, with what it waits for memory.
AnalyticModel::SortCycles sort_cycles(const SortingUnit::Config& config, double entries,
                                      const FrontEndLoad& front);
AnalyticModel::SortCycles sort_cycles(const HierarchicalSorter::Config& config, double entries,
                                      double walked, const FrontEndLoad& front);

} // namespace degs
