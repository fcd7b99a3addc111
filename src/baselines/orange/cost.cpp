// SPDX-License-Identifier: Apache-2.0
// The bill of materials of ORANGE, and the activity of each block of it; docs/cost.md explains both.
#include "baselines/orange/engine.hpp"

namespace degs::orange {

// What a core moves per cycle while all of it works: operands and results of the array, and the values of the vector
// unit.
cost::BillOfMaterials Config::bill() const {
    const cost::Technology::Orange& rows = cost.orange;
    constexpr int kReadAndWritten = 2;
    const SystolicArray::Config& array = cores.array;
    cost::BillOfMaterials bill(cost, clock_ghz);
    bill.add_units({"projection", "Projection, on the vector units.", true}, rows.preprocessing,
                   projection.count, 1 - rows.sorting_share);
    bill.add_units({"sorting", "Sorting, on the vector units.", true}, rows.preprocessing,
                   sorting.count, rows.sorting_share);
    bill.add_units({"systolic_arrays", "Multipliers of the systolic arrays."}, rows.array, pes(), 1,
                   cost.pe_factors(pipeline.precision()));
    bill.add_units({"vector_units", "Lanes of the vector units."}, rows.vector_unit,
                   cores.count * cores.vector.lanes, 1, cost.pe_factors(pipeline.precision()));
    bill.add_sram({"scratchpad", "Memories of the cores."}, rows.sram,
                  std::int64_t{cores.count} * scratchpad.bytes,
                  cores.count * scratchpad.value_bytes *
                      (array.rows + kReadAndWritten * array.columns));
    bill.add_sram({"pixel_buffer", "State of the pixels of the tiles in flight."}, rows.sram,
                  pixel_buffer.bytes,
                  kReadAndWritten * cores.count * pixel_bytes() * cores.vector.lanes /
                      cores.vector.blend_operations);
    return bill;
}

// A batch is written and read once in each of its three places.
void Engine::collect_activity(AcceleratorResult& result) const {
    using V = VectorUnit::Stats;
    const VectorUnit::Config& vector = config_.cores.vector;
    const auto rate = [](std::uint64_t count) { return rate_of(count, 1); };
    const double formed = rate(sum_of(vector_units_, &V::splats));
    const double blended = rate(sum_of(vector_units_, &V::splats_blended)) * config_.tile_area();
    add_activity(result, "systolic_arrays", result.slots.executed());
    add_activity(result, "vector_units",
                 formed * vector.coefficient_operations + blended * vector.blend_operations);
    const double per_splat =
        double(config_.splat_batch_bytes() + config_.coefficient_batch_bytes() +
               config_.product_batch_bytes()) /
        config_.fetching.chunk;
    add_activity(result, "scratchpad",
                 2 * formed * per_splat +
                     rate(front_end().keys_moved()) * config_.traffic.list_entry_bytes);
    add_pixel_activity(result, job(), config_.pixel_bytes());
}

} // namespace degs::orange
