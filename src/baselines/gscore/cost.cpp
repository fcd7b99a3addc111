// SPDX-License-Identifier: Apache-2.0
// The bill of materials of GSCore, and the activity of its arrays; docs/cost.md explains both.
// ArrayAccelerator counts the activity of the other blocks.
#include "baselines/gscore/engine.hpp"

namespace degs::gscore {

void CostRows::describe(cost::RowSection& section) {
    section.row("preprocessing", preprocessing,
                "P & S: pairs of a culling and conversion unit and a sorting unit");
    section.share("sorting_share", sorting_share,
                  "share of P & S that sorts, as in DeGS [assumed]");
    section.row("blending", blending, "lanes");
    section.row("sram", sram, "all buffers");
}

void Config::describe_rows(ConfigVisitor& visitor) {
    cost::RowSection section("gscore", "rows of GSCore (paper Table I)", cost, visitor);
    cost_rows.describe(section);
    section.end();
}

// The reference traffic of the buffer: a splat per cycle for the array, and keys in both steps.
cost::BillOfMaterials Config::bill() const {
    const CostRows& rows = cost_rows;
    constexpr int kReadAndWritten = 2;
    constexpr int kSortingSteps = 2;
    cost::BillOfMaterials bill(cost, clock_ghz);
    const double arithmetic = projection.arithmetic(pipeline.rules.projection);
    bill.add_units({"projection", "Culling and conversion units.", true}, rows.preprocessing,
                   projection.count, 1 - rows.sorting_share, {arithmetic, arithmetic});
    bill.add_units({"sorting", "Hierarchical sorting units.", true}, rows.preprocessing,
                   sorting.count, rows.sorting_share);
    bill.add_units({"blending", "Lanes of the volume rendering cores."}, rows.blending, pes(), 1,
                   cost.pe_factors(pipeline.precision()));
    bill.add_sram({"gaussian_buffer", "Sorted splats and lists being sorted."}, rows.sram,
                  std::int64_t{clusters} * shared_bytes(),
                  kReadAndWritten * (clusters * traffic.splat_bytes +
                                     kSortingSteps * sorting.count * traffic.list_entry_bytes));
    add_binning(bill, rows.sram);
    bill.add_sram({"pixel_buffer", "State of the pixels of the tiles in flight."}, rows.sram,
                  std::int64_t{clusters} * pixel_buffer.bytes,
                  kReadAndWritten * pes() * pixel_bytes());
    return bill;
}

void Engine::collect_activity(AcceleratorResult& result) const {
    add_activity(result, "blending", result.slots.executed());
}

} // namespace degs::gscore
