// SPDX-License-Identifier: Apache-2.0
#include "baselines/gscore/gscore.hpp"

#include "base/grouped_number.hpp"

namespace degs {
namespace {

TileArrayEngine::Parts parts_of(const GscoreConfig& config) {
    TileArrayEngine::Parts parts(config);
    parts.granted = config.clusters > 1;
    parts.engines = config.clusters;
    parts.contexts = config.contexts();
    parts.splat_chunks = config.splat_chunks();
    parts.buffer_bytes = config.buffer.bytes - config.pixel_buffer.bytes;
    parts.pixel_bytes = config.pixel_bytes();
    parts.writeback_cycles = config.array.pipeline_cycles;
    return parts;
}

} // namespace

Gscore::Gscore(const sc_core::sc_module_name& name, const GscoreConfig& config,
               const Timebase& time, RenderJob& job, const BuildOptions& options)
    : TileArrayEngine(name, parts_of(config), time, job, options), config_(config), boxes_(job) {
    for (int c = 0; c < config_.clusters; ++c) {
        arrays_.push_back(std::make_unique<LockstepArray>(
            name_of("array", c).c_str(), config_.array, time, job, boxes_, share_of(c)));
        connect(*arrays_.back());
    }
}

std::unique_ptr<RenderEngine> GscoreConfig::build(const char* module, const Timebase& time,
                                                  RenderJob& job,
                                                  const BuildOptions& options) const {
    return std::make_unique<Gscore>(module, *this, time, job, options);
}

void Gscore::collect_array(AcceleratorResult& result) const {
    using A = LockstepArray::Stats;
    collect_slots(result);
    const std::uint64_t groups = config_.array.clusters;
    add_stage(result, {"blending", "Clusters of the Lockstep Array.", true},
              arrays_.size() * groups, sum_of(arrays_, &A::passes) * groups,
              Counters().add(arrays_));
    add_activity(result, "blending", result.slots.executed());
    collect_laws(result);
    result.left_out.push_back(
        grouped(sum_of(arrays_, &A::splats_skipped)) +
        " splats took no slot: their sub-tiles had ended, or their box meets none.");
    result.left_out.push_back(grouped(sum_of(arrays_, &A::splats_discarded)) +
                              " splats had been fetched when their tile stopped.");
}

void Gscore::collect_slots(AcceleratorResult& result) const {
    for (const auto& array : arrays_) {
        add_slots(result, array->stats().slots, array->stats().window);
    }
    for (const auto& array : arrays_) {
        close_slots(result, array->stats().window, config_.array.lanes);
    }
}

void Gscore::collect_laws(AcceleratorResult& result) const {
    using A = LockstepArray::Stats;
    const SlotAccount& s = result.slots;
    auto& laws = result.conservation;
    laws.push_back({"records fetched = splats worked on + discarded", records_fetched(),
                    sum_of(arrays_, &A::splats) + sum_of(arrays_, &A::splats_discarded)});
    laws.push_back({"lanes x passes = lanes evaluated",
                    sum_of(arrays_, &A::passes) * config_.array.lanes,
                    s.useful + s.boundary + s.terminated});
    if (granted()) {
        laws.push_back(
            {"tiles granted = worked on", dispatcher().stats().tiles, sum_of(arrays_, &A::tiles)});
    }
    if (!front_end().hierarchical().empty()) {
        using H = HierarchicalSorter::Stats;
        const auto& sorters = front_end().hierarchical();
        laws.push_back({"list entries = keys sorted + cancelled", list_entries(),
                        sum_of(sorters, &H::keys_sorted) + sum_of(sorters, &H::keys_cancelled)});
    }
}

} // namespace degs
