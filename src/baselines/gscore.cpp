// SPDX-License-Identifier: Apache-2.0
#include "baselines/gscore.hpp"

#include "config/grouped_number.hpp"

namespace degs {
namespace {

TileArrayEngine::Parts parts_of(const GscoreConfig& config) {
    TileArrayEngine::Parts parts;
    parts.front.projection = config.projection;
    parts.front.binning = config.binning;
    parts.front.hierarchical = config.sorting;
    parts.front.on_demand = true;
    parts.front.traffic = config.traffic;
    parts.front.sort_capacity = config.sort_capacity();
    parts.front.frames_in_flight = config.frames_in_flight;
    parts.fetching = config.fetching;
    parts.pixel_buffer = config.pixel_buffer;
    parts.monitor = config.monitor;
    parts.memory = config.memory;
    parts.frame_end = config.frame_end;
    parts.contexts = config.tile_contexts();
    parts.splat_chunks = config.splat_chunks();
    parts.buffer_bytes = config.buffer.bytes - config.pixel_buffer.bytes;
    parts.pixel_bytes = config.pixel_bytes();
    parts.writeback_cycles = config.array.pipeline_cycles;
    return parts;
}

} // namespace

Gscore::Gscore(const sc_core::sc_module_name& name, const GscoreConfig& config,
               const Timebase& time, RenderJob& job, const BuildOptions& options)
    : TileArrayEngine(name, parts_of(config), time, job, options), config_(config),
      array_("array", config.array, time, job, streams(), config.tile_contexts()) {
    connect(array_);
}

std::unique_ptr<RenderEngine> GscoreConfig::build(const char* module, const Timebase& time,
                                                  RenderJob& job,
                                                  const BuildOptions& options) const {
    return std::make_unique<Gscore>(module, *this, time, job, options);
}

void Gscore::collect_array(AcceleratorResult& result) const {
    const LockstepArray::Stats& array = array_.stats();
    result.slots = array.slots;
    result.window = array.window;
    add_stage(result, {"blending", "Clusters of the Lockstep Array."}, config_.array.clusters,
              array.passes * config_.array.clusters, counters_of(array));
    add_activity(result, "blending", result.slots.executed());
    collect_laws(result);
    result.left_out.push_back(
        grouped(array.splats_skipped) +
        " splats took no slot: their sub-tiles had ended, or their box meets none.");
    result.left_out.push_back(grouped(array.splats_discarded) +
                              " splats had been fetched when their tile stopped.");
}

void Gscore::collect_laws(AcceleratorResult& result) const {
    const LockstepArray::Stats& array = array_.stats();
    const SlotAccount& s = result.slots;
    auto& laws = result.conservation;
    laws.push_back({"records fetched = splats worked on + discarded", records_fetched(),
                    array.splats + array.splats_discarded});
    laws.push_back({"lanes x passes = lanes evaluated", array.passes * config_.array.lanes,
                    s.useful + s.boundary + s.terminated});
    if (!front_end().hierarchical().empty()) {
        using H = HierarchicalSorter::Stats;
        const auto& sorters = front_end().hierarchical();
        laws.push_back({"list entries = keys sorted + cancelled", list_entries(),
                        sum_of(sorters, &H::keys_sorted) + sum_of(sorters, &H::keys_cancelled)});
    }
}

} // namespace degs
