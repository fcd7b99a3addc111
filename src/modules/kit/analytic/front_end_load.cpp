// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/front_end_load.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "modules/kit/analytic/preparation_dates.hpp"
#include "modules/kit/front_end/list_writes.hpp"
#include "tlm/scattered_records.hpp"

namespace degs {
namespace {

double as_real(std::uint64_t count) {
    return static_cast<double>(count);
}

/// Smallest n with ways^n >= keys, at least 1.
double passes_of(double keys, double ways) {
    double passes = 1;
    for (double sorted = ways; sorted < keys; sorted *= ways) {
        ++passes;
    }
    return passes;
}

/// Halvings until a part is not longer than `most`.
double halvings(double keys, double most) {
    double levels = 0;
    for (double part = keys; part > most; part /= 2) {
        ++levels;
    }
    return levels;
}

/// Entries of the lists by chunk of Gaussians.
std::vector<std::uint64_t> pairs_of_chunks(const FrameWorkload& frame, int chunk) {
    std::vector<std::uint64_t> pairs((frame.gaussians + chunk - 1) / chunk, 0);
    for (std::size_t s = 0; s < frame.splats.size(); ++s) {
        pairs[frame.splats[s].id / chunk] += frame.tiles_touched[s];
    }
    return pairs;
}

} // namespace

double scattered_bytes(int record, int burst) {
    return record - std::gcd(record, burst) + burst;
}

ListWritingLoad list_writing(const FrameWorkload& frame, const TrafficConfig& traffic,
                             const TileBinner::Config& binning) {
    ListWritingLoad load;
    if (binning.entries == ListWriting::Stream) {
        load.bytes = as_real(frame.tile_pairs()) * traffic.list_entry_bytes;
        return load;
    }
    ListWrites writes(traffic, binning.entries);
    writes.begin(frame, std::vector<bool>(frame.tile_pairs(), true));
    const std::uint64_t room = std::max(1, binning.buffer_bytes / 2 / traffic.list_entry_bytes);
    const std::uint32_t near_heads = binning.head_bytes / kListHeadBytes;
    double bursts = 0, far_heads = 0, groups = 0;
    for (std::uint64_t done = 0; done < writes.entries(); done += room) {
        const ListWrites::Batch& batch = writes.next(std::min(room, writes.entries() - done));
        bursts += as_real(batch.bursts.size());
        groups += as_real(batch.tiles.size());
        for (const std::uint32_t tile : batch.tiles) {
            far_heads += tile >= near_heads ? 1 : 0;
        }
    }
    load.bytes = (bursts + 2 * far_heads) * traffic.burst_bytes;
    const double waiting = binning.entries == ListWriting::Combined
                               ? as_real(writes.entries()) * traffic.list_entry_bytes
                               : 0;
    load.sram_bytes = 2 * (waiting + (groups - far_heads) * kListHeadBytes); // read and written
    load.cycles = bursts * std::ceil(1.0 * traffic.burst_bytes / traffic.list_entry_bytes) /
                  binning.pairs_per_cycle;
    return load;
}

PreparationCycles FrontEndLoad::preparation(const FrameWorkload& frame,
                                            std::size_t memory_unit) const {
    const ListWritingLoad lists = list_writing(frame, traffic, binning);
    const double pairs = as_real(frame.tile_pairs());
    const std::vector<std::uint64_t> pairs_of = pairs_of_chunks(frame, projection.chunk);
    const double each = projection.project_cycles(frame.projection.rule);
    ScatteredRecords sh;
    sh.stride = sh.bytes = traffic.sh_size(frame.sh_degree);
    sh.burst = traffic.burst_bytes;
    sh.neighbours_share = true;
    PreparationDates dates(projection, binning, memory);
    PreparationCycles result;
    double projecting = 0, shading = 0;
    for (std::size_t c = 0; c < pairs_of.size(); ++c) {
        const std::uint64_t first = c * projection.chunk;
        const std::uint64_t end = std::min(first + projection.chunk, frame.gaussians);
        const std::uint32_t first_visible = frame.visible_among(first);
        sh.numbers = frame.visible_of.data() + first_visible;
        sh.count = frame.visible_among(end) - first_visible;
        const double gaussians = as_real(end - first), visible = as_real(sh.count);
        const double share = pairs == 0 ? 0 : as_real(pairs_of[c]) / pairs;
        PreparationDates::Chunk chunk;
        chunk.projecting = gaussians * each;
        chunk.shading = visible * projection.cycles_per_colour;
        chunk.binning = std::max(
            {1.0, std::ceil(as_real(pairs_of[c]) / binning.pairs_per_cycle), lists.cycles * share});
        const double written = visible * traffic.splat_bytes + lists.bytes * share;
        const double coloured =
            traffic.sh == ShReads::All ? gaussians * as_real(sh.bytes) : as_real(sh.total_bytes());
        chunk.bytes = gaussians * traffic.geometry_size() + coloured + written;
        dates.add(chunk);
        projecting += chunk.projecting;
        shading += chunk.shading;
        result.binning += chunk.binning;
        result.bytes += chunk.bytes;
        result.written += written;
    }
    result.binning_bytes = lists.sram_bytes;
    result.busy[kProjectionUnits] = std::max(projecting, shading) / projection.count;
    result.busy[memory_unit] = memory.stream_cycles(result.bytes);
    result.time = dates.end();
    return result;
}

double FrontEndLoad::fetch_cycles(double walked) const {
    const double ahead = as_real(places); // of a tile, while those before it are rendered
    const double in_flight = fetching.chunk * fetching.chunks_in_flight;
    const double paced = std::max(0.0, walked - ahead) * cycles_per_chunk() / in_flight;
    return std::max(paced, walked / fetching.chunk);
}

double FrontEndLoad::chunk_bytes() const {
    return fetching.chunk * scattered_bytes(traffic.splat_bytes, traffic.burst_bytes);
}

double FrontEndLoad::cycles_per_chunk() const {
    return memory.latency + memory.cycles(chunk_bytes());
}

double FrontEndLoad::tile_bytes(const CoarseTile& tile, double outside) const {
    return (1 + 2 * outside) * tile.entries() * traffic.list_entry_bytes +
           tile.pixels() * traffic.pixel_bytes;
}

double FrontEndLoad::record_bytes() const {
    return scattered_bytes(traffic.splat_bytes, traffic.burst_bytes);
}

double FrontEndLoad::bytes_written(const CoarseTile& tile, double outside) const {
    return outside * tile.entries() * traffic.list_entry_bytes +
           tile.pixels() * traffic.pixel_bytes;
}

double FrontEndLoad::fetched(const CoarseTile& tile, double walked, double array,
                             double fetchers) const {
    const double moved = fetchers * memory.cycles(tile_bytes(tile, 0) + walked * record_bytes());
    const double idle = moved < array ? 1 - moved / array : 0;
    const double filled = as_real(places);
    const double asked = std::min(filled, 1.0 * fetching.chunk * fetching.chunks_in_flight);
    return std::min(tile.entries(), walked + asked + (filled - asked) * idle);
}

std::vector<cost::Activity> FrontEndLoad::activity(const PreparationCycles& before,
                                                   const TileCycles& tiles) const {
    std::vector<cost::Activity> activity{
        {"projection", before.busy[kProjectionUnits] * projection.count},
        {"sorting", tiles.sorting}};
    if (binning.more_pairs() != 0) {
        activity.push_back({"binning", before.binning * binning.more_pairs()});
    }
    if (binning.sram_bytes() != 0) {
        activity.push_back({"binning_buffer", before.binning_bytes});
    }
    return activity;
}

cost::Activity pixel_activity(const TileCycles& tiles, double pixel_bytes, int slots_per_fragment) {
    const double tasks = (tiles.slots + tiles.fragments) / slots_per_fragment;
    return {"pixel_buffer", (tasks + tiles.pixels) * pixel_bytes};
}

AnalyticModel::SortCycles sort_cycles(const SortingUnit::Config& config, double entries,
                                      const FrontEndLoad& front) {
    const double room = as_real(front.sort_capacity);
    const double passes = passes_of(std::min(entries, room), config.merge_ways);
    const double needed =
        entries > room ? passes_of(std::ceil(entries / room), config.merge_ways) : 0;
    const double outside = std::max<double>(needed, config.memory_passes);
    const double all = entries * (passes + outside) / config.keys_per_cycle;
    const double waited = outside * 2 * front.list_access_cycles(entries); // written and read
    return {all + waited, all + waited, all, entries, outside};
}

AnalyticModel::SortCycles sort_cycles(const HierarchicalSorter::Config& config, double entries,
                                      double walked, const FrontEndLoad& front) {
    const double chunk = config.chunk;
    const double outside =
        std::max<double>(halvings(entries, as_real(front.sort_capacity)), config.memory_levels);
    const double levels = std::max(outside, halvings(entries, chunk));
    const double coarse = entries * levels / config.keys_per_cycle;
    const double sorted = std::min(entries, std::ceil(walked / chunk + 1) * chunk);
    const double fine = sorted * config.fine_cycles_per_key + std::ceil(entries / chunk);
    AnalyticModel::SortCycles sort;
    sort.busy = std::max(coarse, fine);
    sort.keys = entries + sorted;
    sort.outside = outside;
    // The loader reads the list for the first level; the second step reads it chunk by chunk.
    const double accesses = std::max(0.0, 2 * outside - 1);
    sort.first_step = coarse + accesses * front.list_access_cycles(entries);
    const double reading = outside == 0 ? 0 : front.list_access_cycles(std::min(entries, chunk));
    sort.first = sort.first_step + std::min(entries, chunk) * config.fine_cycles_per_key + reading;
    sort.all = sort.first_step + fine + std::ceil(sorted / chunk) * reading;
    sort.run = std::min(entries, chunk) * config.fine_cycles_per_key + 1 + reading;
    return sort;
}

} // namespace degs
