// SPDX-License-Identifier: Apache-2.0
// The counters of GSCore in the terms that all accelerators share.
#include "base/grouped_number.hpp"
#include "baselines/gscore/engine.hpp"

namespace degs::gscore {

void Engine::collect_array(AcceleratorResult& result) const {
    using A = LockstepArray::Stats;
    collect_slots(result);
    const std::uint64_t groups = config_.array.clusters;
    add_stage(result, {"blending", "Clusters of the Lockstep Array.", true},
              arrays_.size() * groups, sum_of(arrays_, &A::passes) * groups,
              Counters().add(arrays_));
    collect_activity(result);
    collect_laws(result);
    result.left_out.push_back(
        grouped(sum_of(arrays_, &A::splats_skipped)) +
        " splats took no slot: their sub-tiles had ended, or their box meets none.");
    result.left_out.push_back(grouped(sum_of(arrays_, &A::splats_discarded)) +
                              " splats had been fetched when their tile stopped.");
}

void Engine::collect_slots(AcceleratorResult& result) const {
    add_array_slots(result, arrays_, config_.array.lanes);
}

void Engine::collect_laws(AcceleratorResult& result) const {
    using A = LockstepArray::Stats;
    const SlotAccount& s = result.slots;
    auto& laws = result.conservation;
    laws.push_back({"records fetched = splats worked on + discarded", records_fetched(),
                    sum_of(arrays_, &A::splats) + sum_of(arrays_, &A::splats_discarded)});
    laws.push_back({"lanes x passes = lanes evaluated",
                    sum_of(arrays_, &A::passes) * config_.array.lanes,
                    s[Slot::Useful] + s[Slot::Boundary] + s[Slot::Terminated]});
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

} // namespace degs::gscore
