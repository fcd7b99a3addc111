// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/sorting_unit.hpp"

#include <algorithm>

#include "tlm/ceil_div.hpp"
#include "tlm/has_process.hpp"

namespace degs {

void SortingUnit::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 64, "units (paper Table I: 4)");
    visitor.integer(
        "keys_per_cycle", keys_per_cycle, 1, 1024,
        "keys per cycle and pass; 4 keeps sorting limited by bandwidth, as the paper says "
        "(Sec. V-E) [assumed]");
    visitor.integer("merge_ways", merge_ways, 2, 1024, "fan-in of a merge pass [assumed]");
    visitor.integer("lists_ahead", lists_ahead, 1, 64,
                    "lists that wait, loaded, for the sorter of a unit [assumed]");
    visitor.integer("memory_passes", memory_passes, 0, 16,
                    "passes through memory of every list at least, written and read once each; 0: "
                    "of those that do not fit the buffer only [assumed]");
}

SortingUnit::SortingUnit(const sc_core::sc_module_name& name, const Config& config,
                         const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                         ListChanges& changes, TileNumber index, std::uint64_t sort_capacity)
    : sc_core::sc_module(name), start("start"), sorted("sorted"),
      loader("loader", traffic, time, job, SorterTiles(job, index, config.count)),
      lists("lists", time), config_(config), traffic_(traffic), job_(job), changes_(changes),
      tiles_(job, index, config.count), sort_capacity_(sort_capacity), sorter_(time),
      loaded_("loaded", time, config.lists_ahead) {
    loader.start.bind(start);
    loader.out.bind(loaded_);
    loaded_.set_billed();
    DEGS_HAS_PROCESS(SortingUnit);
    SC_THREAD(sort);
    sorter_.show(*this, stats_.sort_busy);
}

void SortingUnit::end_of_elaboration() {
    loaded_.connect_reader(sorter_);
    sorted->connect_writer(sorter_);
}

std::uint64_t SortingUnit::passes(std::uint64_t keys) const {
    std::uint64_t count = 0;
    for (std::uint64_t runs = keys; runs > 1; ++count) {
        runs = (runs + config_.merge_ways - 1) / config_.merge_ways;
    }
    return std::max<std::uint64_t>(count, 1);
}

std::uint64_t SortingUnit::keys_moved(const JobTile& tile) {
    const auto sorting = [this](std::uint64_t keys) {
        return keys * passes(std::min(keys, sort_capacity_));
    };
    const std::uint64_t fresh = changes_.written(tile);
    return fresh == tile.count ? sorting(fresh) : sorting(fresh) + tile.count; // and one merge
}

void SortingUnit::sort() {
    const std::uint64_t entry = traffic_.list_entry_bytes;
    const std::uint64_t rate = config_.keys_per_cycle;
    while (tiles_.may_follow()) {
        const TileNumber number = loaded_.get(sorter_);
        tiles_.pass(number);
        const JobTile& tile = job_.tiles[number];
        const MemoryMap map = job_.map(tile.frame, traffic_);
        const std::uint64_t runs = (tile.count + sort_capacity_ - 1) / sort_capacity_;
        const Cycle busy = ceil_div(keys_moved(tile), rate);
        sorter_.work(busy, stats_.sort_busy);
        // Runs that do not fit the buffer together go out and come back once per extra merge pass.
        const std::uint64_t needed = runs > 1 ? passes(runs) : 0;
        const std::uint64_t outside =
            std::max(needed, static_cast<std::uint64_t>(config_.memory_passes));
        for (std::uint64_t pass = 0; pass < outside; ++pass) {
            const std::uint64_t bytes = tile.count * entry;
            sorter_.wait_for_memory(lists.write(sorter_, map.lists + tile.first * entry, bytes));
            sorter_.wait_for_memory(lists.read(sorter_, map.lists + tile.first * entry, bytes));
            const Cycle merge = (tile.count + rate - 1) / rate;
            sorter_.work(merge, stats_.sort_busy);
            stats_.memory_passes++;
        }
        if (changes_.lists_are_kept()) {
            lists.write(sorter_, map.lists + tile.first * entry, tile.count * entry);
        }
        stats_.keys += tile.count;
        sorted->put(sorter_, {number, tile.count});
    }
    sorted->put(sorter_, {kNoTile, 0});
    sorter_.finish();
}

} // namespace degs
