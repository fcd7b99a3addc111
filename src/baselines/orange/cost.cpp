// SPDX-License-Identifier: Apache-2.0
// The bill of materials of ORANGE, and the activity of each block of it; docs/cost.md explains
// both.
#include "baselines/orange/engine.hpp"

namespace degs::orange {

void CostRows::describe(cost::RowSection& section) {
    section.row("preprocessing", preprocessing,
                "projection and sorting: energy as in GSCore, on the area of the vector units");
    section.share("sorting_share", sorting_share,
                  "share of preprocessing that sorts, as in GSCore [assumed]");
    section.row("array", array,
                "multipliers of the systolic arrays: FP16 units of 3000 um2 and 1.5 pJ "
                "(Horowitz, ISSCC 2014, at 45 nm), 0.39 of the area and half of the energy at "
                "28 nm [assumed]");
    section.row("vector_unit", vector_unit,
                "lanes of the vector units: 1.7 and 2 times as much as a multiplier [assumed]");
    section.row("sram", sram,
                "scratchpads and Pixel Buffer: what is left of the area, at GSCore's area and "
                "energy per byte [assumed]");
}

void Config::describe_rows(ConfigVisitor& visitor) {
    cost::RowSection section("orange",
                             "ORANGE with four cores: 13.74 mm2 in all, its only public figure",
                             cost, visitor);
    cost_rows.describe(section);
    section.end();
}

// What a core moves per cycle while all of it works: operands and results of the array, and the
// values of the vector unit.
cost::BillOfMaterials Config::bill() const {
    const CostRows& rows = cost_rows;
    constexpr int kReadAndWritten = 2;
    const SystolicArray::Config& array = cores.array;
    cost::BillOfMaterials bill(cost, clock_ghz);
    const double arithmetic = projection.arithmetic(pipeline.rules.projection);
    bill.add_units({"projection", "Projection, on the vector units.", true}, rows.preprocessing,
                   projection.count, 1 - rows.sorting_share, {arithmetic, arithmetic});
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
    add_binning(bill, rows.sram);
    bill.add_sram({"pixel_buffer", "State of the pixels of the tiles in flight."}, rows.sram,
                  pixel_buffer.bytes,
                  kReadAndWritten * cores.count * pixel_bytes() * cores.vector.lanes /
                      cores.vector.blend_operations);
    return bill;
}

// A batch is written and read once in each of its three places.
std::vector<cost::Activity> Config::activity(const Work& work) const {
    const VectorUnit::Config& vector = cores.vector;
    const double per_splat =
        double(splat_batch_bytes() + coefficient_batch_bytes() + product_batch_bytes()) /
        fetching.chunk;
    return {
        {"systolic_arrays", work.slots},
        {"vector_units", work.formed * vector.coefficient_operations +
                             work.blended * tile_area() * vector.blend_operations},
        {"scratchpad", 2 * work.formed * per_splat + work.keys_moved * traffic.list_entry_bytes}};
}

void Engine::collect_activity(AcceleratorResult& result) const {
    using V = VectorUnit::Stats;
    Work work;
    work.slots = real_of(result.slots.executed());
    work.formed = real_of(sum_of(vector_units_, &V::splats));
    work.blended = real_of(sum_of(vector_units_, &V::splats_blended));
    work.keys_moved = real_of(front_end().keys_moved());
    add_activity(result, config_.activity(work));
    add_pixel_activity(result, job(), config_.pixel_bytes());
}

} // namespace degs::orange
