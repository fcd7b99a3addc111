// SPDX-License-Identifier: Apache-2.0
// The counters of GBU in the terms that all accelerators share.
#include "baselines/gbu.hpp"
#include "config/grouped_number.hpp"

namespace degs {

/// PE-cycles of all engines: an engine knows its own from its first to its last slot.
void Gbu::collect_slots(AcceleratorResult& result) const {
    for (const auto& engine : engines_) {
        result.slots += engine->stats().slots;
        result.window.include(engine->stats().window);
    }
    const auto width = static_cast<std::uint64_t>(config_.engines.row_pes);
    for (const auto& engine : engines_) {
        const ActiveWindow& own = engine->stats().window;
        if (own.empty()) {
            result.slots.drain += result.window.cycles() * width;
        } else {
            result.slots.starved += (own.first - result.window.first) * width;
            result.slots.drain += (result.window.last - own.last) * width;
        }
    }
}

void Gbu::collect_stages(AcceleratorResult& result) const {
    front_end_->collect(result);
    using D = TileDispatcher::Stats;
    const D& dispatched = dispatcher_->stats();
    add_stage(result, "dispatch", 1, dispatched.tiles,
              {{"tiles", dispatched.tiles},
               {"list_wait_cycles", dispatched.list_wait},
               {"request_wait_cycles", dispatched.request_wait}});
    using F = SplatFetcher::Stats;
    add_stage(result, "fetching", fetchers_.size(), sum_of(fetchers_, &F::busy),
              {{"records", sum_of(fetchers_, &F::records)},
               {"records_cancelled", sum_of(fetchers_, &F::records_cancelled)}});
    using E = TileEngine::Stats;
    add_stage(result, "row_generation", engines_.size(), sum_of(engines_, &E::splats),
              {{"splats", sum_of(engines_, &E::splats)},
               {"splats_abandoned", sum_of(engines_, &E::splats_abandoned)},
               {"rows_skipped", sum_of(engines_, &E::rows_skipped)},
               {"queue_wait_cycles", sum_of(engines_, &E::queue_wait)},
               {"input_wait_cycles", sum_of(engines_, &E::input_wait)}});
    const SlotAccount& s = result.slots;
    add_stage(result, "row_pes", static_cast<std::size_t>(config_.pes()),
              s.useful + s.boundary + s.terminated,
              {{"entries", sum_of(engines_, &E::entries)},
               {"entries_dropped", sum_of(engines_, &E::entries_dropped)},
               {"pixels", sum_of(engines_, &E::pixels)},
               {"pixels_ended", sum_of(engines_, &E::pixels_ended)},
               {"drain_slots", sum_of(engines_, &E::drain_slots)}});
}

void Gbu::collect_buffers(AcceleratorResult& result) const {
    BufferUse lists;
    lists.name = "list_buffer";
    lists.bytes = config_.list_buffer.bytes;
    lists.counts = {{"keys_per_unit", static_cast<std::uint64_t>(config_.sort_capacity())}};
    result.buffers.push_back(lists);
    add_buffer(result, "splat_buffer", config_.splat_buffer_bytes(), config_.list_buffer.chunks,
               splat_buffer());
    BufferUse queues;
    queues.name = "row_queues";
    queues.bytes = config_.queue_bytes();
    queues.counts = {
        {"queues", static_cast<std::uint64_t>(config_.pes())},
        {"entries_per_queue", static_cast<std::uint64_t>(config_.engines.queue_depth)}};
    result.buffers.push_back(queues);
    if (!caches_.empty()) {
        std::uint64_t hits = 0;
        std::uint64_t misses = 0;
        for (const auto& cache : caches_) {
            hits += cache->stats().hits;
            misses += cache->stats().misses;
        }
        BufferUse use;
        use.name = "reuse_cache";
        use.bytes = config_.reuse_cache.bytes;
        use.counts = {{"records_per_engine", static_cast<std::uint64_t>(config_.cache_records())},
                      {"hits", hits},
                      {"misses", misses}};
        result.buffers.push_back(use);
    }
    add_pixel_buffer(result, config_.pixel_buffer.bytes, config_.tile_contexts(), pixel_buffers_);
}

void Gbu::collect_laws(AcceleratorResult& result) const {
    using E = TileEngine::Stats;
    using F = SplatFetcher::Stats;
    std::uint64_t listed = 0;
    for (const JobTile& tile : job_.tiles) {
        listed += tile.count;
    }
    const std::uint64_t fetched = sum_of(fetchers_, &F::records);
    const std::uint64_t probes = config_.engines.end_probe ? sum_of(engines_, &E::entries) : 0;
    const SlotAccount& s = result.slots;
    result.conservation = {
        {"splats listed = fetched + cancelled", listed,
         fetched + sum_of(fetchers_, &F::records_cancelled)},
        {"splats fetched = taken by Row Generation + abandoned", fetched,
         sum_of(engines_, &E::splats) + sum_of(engines_, &E::splats_abandoned)},
        {"pixels of row entries + end probes = slots executed",
         sum_of(engines_, &E::pixels) + probes, s.useful + s.boundary + s.terminated},
        {"tiles granted = worked on", dispatcher_->stats().tiles, sum_of(engines_, &E::tiles)},
    };
}

void Gbu::collect(AcceleratorResult& result) const {
    collect_frames(result, pixel_buffers_, frame_ends_.background());
    result.tiles = finished_tiles();
    result.tiles_cancelled = sum_of(monitors_, &TileMonitor::Stats::tiles_cancelled);
    collect_slots(result);
    collect_stages(result);
    collect_buffers(result);
    streams_.collect(result);
    collect_laws(result);
    using E = TileEngine::Stats;
    explain_tiles(result, sum_of(fetchers_, &SplatFetcher::Stats::records_cancelled));
    result.left_out.push_back(grouped(sum_of(engines_, &E::rows_skipped)) +
                              " rows of splats were left out and " +
                              grouped(sum_of(engines_, &E::entries_dropped)) +
                              " row entries dropped, because every pixel of the row had ended.");
}

} // namespace degs
