// SPDX-License-Identifier: Apache-2.0
// The counters of ORANGE in the terms that all accelerators share.
#include "base/grouped_number.hpp"
#include "baselines/orange/engine.hpp"

namespace degs::orange {

void Engine::collect_engines(AcceleratorResult& result) const {
    collect_slots(result);
    collect_stages(result);
    collect_buffers(result);
    collect_activity(result);
    collect_laws(result);
    using V = VectorUnit::Stats;
    result.left_out.push_back(grouped(sum_of(vector_units_, &V::splats_abandoned)) +
                              " splats had been fetched, and the products of " +
                              grouped(sum_of(vector_units_, &V::splats_wasted)) +
                              " had been formed, when every pixel of their tile had ended.");
}

void Engine::collect_slots(AcceleratorResult& result) const {
    result.slots_per_fragment = kGemmDepth;
    for (const auto& unit : vector_units_) {
        add_slots(result, unit->account().slots(), unit->account().window());
    }
    for (const auto& unit : vector_units_) {
        close_slots(result, unit->account().window(), config_.cores.array.macs());
    }
}

void Engine::collect_stages(AcceleratorResult& result) const {
    using A = SystolicArray::Stats;
    add_stage(result, {"systolic_arrays", "Systolic arrays, busy with a product.", true},
              arrays_.size(), sum_of(arrays_, &A::busy), Counters().add(arrays_));
    add_stage(result, {"vector_units", "Vector units, which form coefficients and blend products."},
              vector_units_.size(), sum_of(vector_units_, &VectorUnit::Stats::busy),
              Counters().add(vector_units_));
}

void Engine::collect_buffers(AcceleratorResult& result) const {
    const Config::Scratchpad& pad = config_.scratchpad;
    const std::int64_t cores = config_.cores.count;
    const auto bytes = [&](int batches, std::int64_t batch) { return cores * batches * batch; };
    add_buffer(result, {"scratchpad", "The memories of the cores."}, cores * pad.bytes)
        .counters.count("keys_per_unit", config_.sort_capacity(), "keys",
                        "List entries that one Sorting Unit holds.");
    add_buffer(result, {"splat_buffer", "Batches of splats on their way to the vector units."},
               bytes(pad.splat_batches, config_.splat_batch_bytes()), pad.splat_batches,
               splat_buffer());
    add_buffer(result, {"coefficients", "Batches of coefficients in front of the arrays."},
               bytes(pad.coefficient_batches, config_.coefficient_batch_bytes()),
               pad.coefficient_batches, use_of(coefficient_rings_));
    add_buffer(result, {"products", "Products in front of the vector units."},
               bytes(pad.product_batches, config_.product_batch_bytes()), pad.product_batches,
               use_of(product_rings_));
    add_pixel_buffer(result, config_.pixel_buffer.bytes, config_.tile_contexts(), pixel_buffers());
}

void Engine::collect_laws(AcceleratorResult& result) const {
    using V = VectorUnit::Stats;
    using A = SystolicArray::Stats;
    const std::uint64_t splats = sum_of(arrays_, &A::splats);
    const std::uint64_t macs = config_.cores.array.macs();
    const SlotAccount& s = result.slots;
    result.conservation.insert(
        result.conservation.end(),
        {
            {"splats listed = fetched + cancelled", list_entries(),
             records_fetched() + records_cancelled()},
            {"splats fetched = with coefficients + abandoned", records_fetched(),
             sum_of(vector_units_, &V::splats) + sum_of(vector_units_, &V::splats_abandoned)},
            {"splats multiplied = blended + thrown away", splats,
             sum_of(vector_units_, &V::splats_blended) + sum_of(vector_units_, &V::splats_wasted)},
            {"products of numbers = splats x pixels of a tile x 6", s.executed(),
             splats * config_.tile_area() * kGemmDepth},
            {"multiplier-cycles of products = executed + padding", sum_of(arrays_, &A::busy) * macs,
             s.executed() + s[Slot::Padding]},
            {"tiles granted = worked on", dispatcher().stats().tiles,
             sum_of(vector_units_, &V::tiles)},
        });
}

} // namespace degs::orange
