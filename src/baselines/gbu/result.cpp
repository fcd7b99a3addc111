// SPDX-License-Identifier: Apache-2.0
// The counters of GBU in the terms that all accelerators share.
#include <utility>

#include "base/grouped_number.hpp"
#include "baselines/gbu/engine.hpp"

namespace degs::gbu {

void Engine::collect_slots(AcceleratorResult& result) const {
    add_array_slots(result, engines_, config_.engines.row_pes);
}

void Engine::collect_stages(AcceleratorResult& result) const {
    Counters generation;
    Counters row_pes;
    for (const auto& engine : engines_) {
        engine->stats().describe_generation(generation);
        engine->stats().describe_row_pes(row_pes);
    }
    add_stage(result, {"row_generation", "Row Generation of the tile engines."}, engines_.size(),
              sum_of(engines_, &TileEngine::Stats::generating), std::move(generation));
    const SlotAccount& s = result.slots;
    add_stage(result, {"row_pes", "Row PEs of the tile engines.", true}, config_.pes(),
              s[Slot::Useful] + s[Slot::Boundary] + s[Slot::Terminated], std::move(row_pes));
}

void Engine::collect_buffers(AcceleratorResult& result) const {
    add_buffer(result, {"list_buffer", "Lists of the Sorting Units."}, config_.list_buffer.bytes)
        .counters.count("keys_per_unit", config_.sort_capacity(), "keys",
                        "List entries that one Sorting Unit holds.");
    add_buffer(result, {"splat_buffer", "Chunks of splats on their way to the tile engines."},
               config_.splat_buffer_bytes(), config_.list_buffer.chunks, splat_buffer());
    Counters& queues = add_buffer(result, {"row_queues", "Row entries that wait for their Row PE."},
                                  config_.queue_bytes())
                           .counters;
    queues.count("queues", config_.pes(), "queues", "One for each Row PE.");
    queues.count("entries_per_queue", config_.engines.queue_depth, "rows",
                 "Row entries that one queue holds.");
    if (!caches().empty()) {
        Counters& counters = add_buffer(result, {"reuse_cache", "Splat records that come again."},
                                        config_.reuse_cache.bytes)
                                 .counters;
        counters.count("records_per_engine", config_.cache_records(), "records",
                       "Splat records that the cache of one engine holds.");
        counters.add(caches());
    }
    add_pixel_buffer(result, config_.pixel_buffer.bytes, config_.tile_contexts(), pixel_buffers());
}

void Engine::collect_laws(AcceleratorResult& result) const {
    using E = TileEngine::Stats;
    const std::uint64_t probes = config_.engines.end_probe ? sum_of(engines_, &E::entries) : 0;
    const SlotAccount& s = result.slots;
    result.conservation.insert(
        result.conservation.end(),
        {
            {"splats listed = fetched + cancelled", list_entries(),
             records_fetched() + records_cancelled()},
            {"splats fetched = taken by Row Generation + abandoned", records_fetched(),
             sum_of(engines_, &E::splats) + sum_of(engines_, &E::splats_abandoned)},
            {"pixels of row entries + end probes = slots executed",
             sum_of(engines_, &E::pixels) + probes,
             s[Slot::Useful] + s[Slot::Boundary] + s[Slot::Terminated]},
            {"tiles granted = worked on", dispatcher().stats().tiles, sum_of(engines_, &E::tiles)},
        });
}

void Engine::collect_engines(AcceleratorResult& result) const {
    collect_slots(result);
    collect_stages(result);
    collect_buffers(result);
    collect_activity(result);
    collect_laws(result);
    using E = TileEngine::Stats;
    result.left_out.push_back(grouped(sum_of(engines_, &E::rows_skipped)) +
                              " rows of splats were left out and " +
                              grouped(sum_of(engines_, &E::entries_dropped)) +
                              " row entries dropped, because every pixel of the row had ended.");
}

} // namespace degs::gbu
