// SPDX-License-Identifier: Apache-2.0
// The bill of materials of GBU, and the activity of each block of it; docs/cost.md explains both.
#include "baselines/gbu/engine.hpp"

namespace degs::gbu {

void CostRows::describe(cost::RowSection& section) {
    section.row("preprocessing", preprocessing,
                "P & S: pairs of a culling and conversion unit and a sorting unit");
    section.share("sorting_share", sorting_share,
                  "share of P & S that sorts, as in DeGS [assumed]");
    section.row(
        "scheduler", scheduler,
        "Row Generation and dispatch; units: rows per cycle. Table I does not shade it, so that it "
        "is one block for any array");
    section.row("blending", blending, "Row PEs");
    section.row("sram", sram, "all buffers");
}

void Config::describe_rows(ConfigVisitor& visitor) {
    cost::RowSection section("gbu", "rows of GBU (paper Table I)", cost, visitor);
    cost_rows.describe(section);
    section.end();
}

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
    bill.add_units({"row_generation", "Row Generation and dispatch of all engines."},
                   rows.scheduler, rows_per_cycle());
    bill.add_units({"row_pes", "Row PEs of the tile engines."}, rows.blending, pes(), 1,
                   cost.pe_factors(pipeline.precision()));
    bill.add_sram({"list_buffer", "Lists of the Sorting Units."}, rows.sram, list_buffer.bytes,
                  kReadAndWritten * kSortingSteps * sorting.count * traffic.list_entry_bytes);
    bill.add_sram({"splat_buffer", "Chunks of splats on their way to the tile engines."}, rows.sram,
                  splat_buffer_bytes(), kReadAndWritten * engines.count * traffic.splat_bytes);
    bill.add_sram({"row_queues", "Row entries that wait for their Row PE."}, rows.sram,
                  queue_bytes(), kReadAndWritten * pes() * engines.entry_bytes);
    bill.add_sram({"reuse_cache", "Splat records that come again."}, rows.sram, reuse_cache.bytes,
                  engines.count * traffic.splat_bytes);
    add_binning(bill, rows.sram);
    bill.add_sram({"pixel_buffer", "State of the pixels of the tiles in flight."}, rows.sram,
                  pixel_buffer.bytes, kReadAndWritten * pes() * pixel_bytes());
    return bill;
}

std::vector<cost::Activity> Config::activity(const Work& work) const {
    // While one engine generates, its share of the units works.
    return {{"row_generation", work.generating / engines.count * rows_per_cycle()},
            {"row_pes", work.slots},
            {"list_buffer", work.keys_moved * traffic.list_entry_bytes},
            {"splat_buffer", 2 * work.splats_fetched * traffic.splat_bytes},
            {"row_queues", work.entries_moved * engines.entry_bytes},
            {"reuse_cache", work.lookups * traffic.splat_bytes}};
}

void Engine::collect_activity(AcceleratorResult& result) const {
    using E = TileEngine::Stats;
    using R = ReuseCache::Stats;
    Work work;
    work.generating = real_of(sum_of(engines_, &E::generating));
    work.slots = real_of(result.slots.executed());
    work.keys_moved = real_of(front_end().keys_moved());
    work.splats_fetched = real_of(records_fetched());
    work.entries_moved =
        real_of(2 * (sum_of(engines_, &E::entries) + sum_of(engines_, &E::entries_dropped)));
    work.lookups = real_of(sum_of(caches(), &R::hits) + sum_of(caches(), &R::misses));
    add_activity(result, config_.activity(work));
    add_pixel_activity(result, job(), config_.pixel_bytes());
}

} // namespace degs::gbu
