// SPDX-License-Identifier: Apache-2.0
#include "modules/sorting_unit.hpp"

#include <algorithm>

namespace degs {

void SortingUnit::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 64, "units (paper Table I: 4)");
    visitor.integer(
        "keys_per_cycle", keys_per_cycle, 1, 1024,
        "keys per cycle and pass; 4 keeps sorting limited by bandwidth, as the paper says "
        "(Sec. V-E) [assumed]");
    visitor.integer("merge_ways", merge_ways, 2, 1024, "fan-in of a merge pass [assumed]");
    visitor.integer("chunk", chunk, 1, 1024, "splat records per request [assumed]");
    visitor.integer("chunks_in_flight", chunks_in_flight, 1, 1024,
                    "record requests outstanding per unit; covers a 100 ns memory [assumed]");
}

SortingUnit::SortingUnit(const sc_core::sc_module_name& name, const Config& config,
                         const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                         int index, std::size_t outputs, std::uint64_t sort_capacity)
    : sc_core::sc_module(name), start("start"), cancel("cancel"), out("out", outputs),
      lists("lists", time), records("records", time), config_(config), traffic_(traffic), job_(job),
      index_(static_cast<std::size_t>(index)), sort_capacity_(sort_capacity), loader_(time),
      sorter_(time), fetcher_(time), loaded_("loaded", time, 1), sorted_("sorted", time, 1),
      answered_(static_cast<std::size_t>(config.chunks_in_flight), 0) {
    SC_HAS_PROCESS(SortingUnit);
    SC_THREAD(load);
    SC_THREAD(sort);
    SC_THREAD(fetch);
}

void SortingUnit::end_of_elaboration() {
    start->connect_reader(loader_);
    loaded_.connect_writer(loader_);
    loaded_.connect_reader(sorter_);
    sorted_.connect_writer(sorter_);
    sorted_.connect_reader(fetcher_);
    cancel->connect_reader(fetcher_);
    for (auto& port : out) {
        port->connect_writer(fetcher_);
    }
}

void SortingUnit::load() {
    const auto entry = static_cast<std::uint64_t>(traffic_.list_entry_bytes);
    std::uint32_t frames_started = 0;
    for (std::size_t t = index_; t < job_.tiles.size();
         t += static_cast<std::size_t>(config_.count)) {
        const JobTile& tile = job_.tiles[t];
        while (frames_started <= tile.frame) {
            start->get(loader_);
            ++frames_started;
        }
        const MemoryMap map(traffic_, job_.frame_of(tile));
        loaded_.reserve(loader_);
        const Cycle ready = lists.read(loader_, map.lists + tile.first * entry, tile.count * entry);
        loaded_.put_at(loader_, static_cast<TileNumber>(t), ready);
        loader_.advance();
    }
    loader_.finish();
}

std::uint64_t SortingUnit::passes(std::uint64_t keys) const {
    std::uint64_t count = 0;
    for (std::uint64_t runs = keys; runs > 1; ++count) {
        runs = (runs + static_cast<std::uint64_t>(config_.merge_ways) - 1) /
               static_cast<std::uint64_t>(config_.merge_ways);
    }
    return std::max<std::uint64_t>(count, 1);
}

void SortingUnit::sort() {
    const auto entry = static_cast<std::uint64_t>(traffic_.list_entry_bytes);
    const auto rate = static_cast<std::uint64_t>(config_.keys_per_cycle);
    for (std::size_t t = index_; t < job_.tiles.size();
         t += static_cast<std::size_t>(config_.count)) {
        const TileNumber number = loaded_.get(sorter_);
        const JobTile& tile = job_.tiles[number];
        const MemoryMap map(traffic_, job_.frame_of(tile));
        const std::uint64_t runs = (tile.count + sort_capacity_ - 1) / sort_capacity_;
        const Cycle busy =
            (tile.count * passes(std::min(tile.count, sort_capacity_)) + rate - 1) / rate;
        sorter_.advance(busy);
        stats_.sort_busy += busy;
        // Runs that do not fit the buffer together go out and come back once per extra merge pass.
        for (std::uint64_t pass = 0; runs > 1 && pass < passes(runs); ++pass) {
            const std::uint64_t bytes = tile.count * entry;
            sorter_.advance_to(lists.write(sorter_, map.lists + tile.first * entry, bytes));
            sorter_.advance_to(lists.read(sorter_, map.lists + tile.first * entry, bytes));
            const Cycle merge = (tile.count + rate - 1) / rate;
            sorter_.advance(merge);
            stats_.sort_busy += merge;
            stats_.memory_passes++;
        }
        stats_.keys += tile.count;
        sorted_.put(sorter_, number);
    }
    sorter_.finish();
}

void SortingUnit::fetch() {
    for (std::size_t t = index_; t < job_.tiles.size();
         t += static_cast<std::size_t>(config_.count)) {
        fetch_tile(sorted_.get(fetcher_));
    }
    fetcher_.finish();
}

// Asks before each request; the question takes a cycle.
bool SortingUnit::cancelled(TileNumber number) {
    while (fetcher_.arrived(*cancel.operator->())) {
        cancelled_before_ = std::max(cancelled_before_, cancel->take(fetcher_) + 1);
    }
    fetcher_.advance();
    return number < cancelled_before_;
}

void SortingUnit::fetch_tile(TileNumber number) {
    const JobTile& tile = job_.tiles[number];
    const MemoryMap map(traffic_, job_.frame_of(tile));
    const auto burst = static_cast<std::uint64_t>(
        std::max(traffic_.burst_bytes, traffic_.splat_bytes)); // records are scattered
    std::uint64_t done = 0;
    while (done < tile.count) {
        SplatChunk chunk;
        chunk.tile = number;
        chunk.first = tile.first + done;
        for (auto& port : out) {
            port->reserve(fetcher_);
        }
        Cycle ready = fetcher_.local();
        if (cancelled(number)) {
            stats_.records_cancelled += tile.count - done;
            done = tile.count;
        } else {
            chunk.count = static_cast<std::uint32_t>(std::min<std::uint64_t>(
                static_cast<std::uint64_t>(config_.chunk), tile.count - done));
            done += chunk.count;
            stats_.records += chunk.count;
            Cycle& oldest = answered_[requests_++ % answered_.size()];
            fetcher_.advance_to(oldest);
            ready = records.read(fetcher_, map.splats, chunk.count * burst);
            oldest = ready;
        }
        chunk.last = done == tile.count;
        for (auto& port : out) {
            port->put_at(fetcher_, chunk, ready);
        }
        fetcher_.advance();
    }
}

} // namespace degs
