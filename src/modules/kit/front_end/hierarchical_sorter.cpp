// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/hierarchical_sorter.hpp"

#include <algorithm>

#include "tlm/ceil_div.hpp"
#include "tlm/has_process.hpp"

namespace degs {
namespace {

/// Halvings until `keys` are no more than `limit`.
std::uint64_t levels(std::uint64_t keys, std::uint64_t limit) {
    std::uint64_t count = 0;
    for (; keys > limit; keys = (keys + 1) / 2) {
        ++count;
    }
    return count;
}

} // namespace

void HierarchicalSorter::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 64, "units; four sorting cores of Lee et al. (ASPLOS 2024)");
    visitor.integer("chunk", chunk, 2, 65536,
                    "keys of a chunk that is sorted exactly; about 256 (Lee et al.)");
    visitor.integer("keys_per_cycle", keys_per_cycle, 1, 1024,
                    "keys per cycle, unit and coarse level: one per quick-sort unit [assumed]");
    visitor.integer("lists_ahead", lists_ahead, 1, 64,
                    "lists that wait for each step, loaded or partitioned [assumed]");
    visitor.integer("memory_levels", memory_levels, 0, 16,
                    "least number of coarse levels of a list that go through memory; 0: those that "
                    "do not fit the buffer [assumed]");
    visitor.integer("fine_cycles_per_key", fine_cycles_per_key, 1, 1024,
                    "cycles per key and unit of the exact step: log2(16) / 2 of a 16-wide bitonic "
                    "unit [assumed]");
}

HierarchicalSorter::HierarchicalSorter(const sc_core::sc_module_name& name, const Config& config,
                                       const TrafficConfig& traffic, const Timebase& time,
                                       const RenderJob& job, ListChanges& changes, TileNumber index,
                                       std::uint64_t capacity)
    : sc_core::sc_module(name), start("start"), cancel("cancel"), sorted("sorted"),
      loader("loader", traffic, time, job, SorterTiles(job, index, config.count)),
      lists("lists", time), chunks("chunks", time), config_(config), traffic_(traffic), job_(job),
      changes_(changes), of_coarse_(job, index, config.count), of_fine_(of_coarse_),
      capacity_(capacity), partitioner_(time), sorter_(time),
      loaded_("loaded", time, config.lists_ahead),
      partitioned_("partitioned", time, config.lists_ahead) {
    loader.start.bind(start);
    loader.out.bind(loaded_);
    loaded_.set_billed();
    partitioned_.set_billed();
    DEGS_HAS_PROCESS(HierarchicalSorter);
    SC_THREAD(coarse);
    SC_THREAD(fine);
    partitioner_.show(*this, stats_.coarse_busy, 1, "coarse");
    sorter_.show(*this, stats_.fine_busy, 1, "fine");
}

void HierarchicalSorter::end_of_elaboration() {
    loaded_.connect_reader(partitioner_);
    partitioned_.connect_writer(partitioner_);
    partitioned_.connect_reader(sorter_);
    cancel->connect_reader(sorter_);
    sorted->connect_writer(sorter_);
}

std::uint64_t HierarchicalSorter::levels_outside(const JobTile& tile) const {
    return std::max(levels(tile.count, capacity_),
                    static_cast<std::uint64_t>(config_.memory_levels));
}

void HierarchicalSorter::coarse() {
    const std::uint64_t entry = traffic_.list_entry_bytes;
    const std::uint64_t rate = config_.keys_per_cycle;
    while (of_coarse_.may_follow()) {
        const TileNumber number = loaded_.get(partitioner_);
        of_coarse_.pass(number);
        const JobTile& tile = job_.tiles[number];
        const MemoryMap map = job_.map(tile.frame, traffic_);
        const Cycle level = ceil_div(changes_.written(tile), rate); // what is kept has its place
        const std::uint64_t outside = levels_outside(tile);
        const std::uint64_t address = map.lists + tile.first * entry;
        // The loader has read the list for the first level.
        for (std::uint64_t i = 0; i < outside; ++i) {
            if (i != 0) {
                partitioner_.wait_for_memory(lists.read(partitioner_, address, tile.count * entry));
            }
            partitioner_.work(level, stats_.coarse_busy);
            partitioner_.wait_for_memory(lists.write(partitioner_, address, tile.count * entry));
        }
        if (changes_.lists_are_kept() && outside == 0) {
            lists.write(partitioner_, address, tile.count * entry);
        }
        const std::uint64_t all = levels(tile.count, config_.chunk);
        partitioner_.work((all - std::min(all, outside)) * level, stats_.coarse_busy);
        stats_.memory_levels += outside;
        stats_.keys += tile.count;
        partitioned_.put(partitioner_, number);
    }
    partitioner_.finish();
}

void HierarchicalSorter::fine() {
    while (of_fine_.may_follow()) {
        const TileNumber number = partitioned_.get(sorter_);
        of_fine_.pass(number);
        sort_chunks(number);
    }
    sorted->put(sorter_, {kNoTile, 0});
    sorter_.finish();
}

void HierarchicalSorter::sort_chunks(TileNumber number) {
    const JobTile& tile = job_.tiles[number];
    const std::uint64_t entry = traffic_.list_entry_bytes;
    for (std::uint64_t done = 0; done < tile.count;) {
        const std::uint64_t count = std::min<std::uint64_t>(config_.chunk, tile.count - done);
        if (cancelled(number)) {
            stats_.keys_cancelled += tile.count - done;
            done = tile.count; // the fetcher knows, too, and reads nothing of it
        } else {
            if (through_memory(tile)) {
                const MemoryMap map = job_.map(tile.frame, traffic_);
                sorter_.wait_for_memory(
                    chunks.read(sorter_, map.lists + (tile.first + done) * entry, count * entry));
            }
            const Cycle busy = count * config_.fine_cycles_per_key;
            sorter_.work(busy, stats_.fine_busy);
            stats_.keys_sorted += count;
            done += count;
        }
        sorted->put(sorter_, {number, done});
    }
}

// Asks before each chunk; the question takes a cycle.
bool HierarchicalSorter::cancelled(TileNumber number) {
    while (sorter_.arrived(cancel.ring())) {
        cancelled_before_ = std::max(cancelled_before_, cancel->take(sorter_) + 1);
    }
    sorter_.advance();
    return number < cancelled_before_;
}

} // namespace degs
