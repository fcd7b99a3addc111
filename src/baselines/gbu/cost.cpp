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
    bill.add_units({"projection", "Culling and conversion units.", true}, rows.preprocessing,
                   projection.count, 1 - rows.sorting_share);
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

void Engine::collect_activity(AcceleratorResult& result) const {
    using E = TileEngine::Stats;
    using R = ReuseCache::Stats;
    const auto bytes = [](std::uint64_t records, int record_bytes) {
        return rate_of(records, 1) * record_bytes;
    };
    const std::uint64_t records = records_fetched();
    const std::uint64_t rows = sum_of(engines_, &E::entries);
    const int splat_bytes = config_.traffic.splat_bytes;
    add_activity(result, "row_generation",
                 rate_of(sum_of(engines_, &E::splats), config_.engines.count) *
                     config_.cost_rows.scheduler.units);
    add_activity(result, "row_pes", result.slots.executed());
    add_activity(result, "list_buffer",
                 bytes(front_end().keys_moved(), config_.traffic.list_entry_bytes));
    add_activity(result, "splat_buffer", bytes(2 * records, splat_bytes));
    add_activity(
        result, "row_queues",
        bytes(2 * (rows + sum_of(engines_, &E::entries_dropped)), config_.engines.entry_bytes));
    add_activity(result, "reuse_cache",
                 bytes(sum_of(caches(), &R::hits) + sum_of(caches(), &R::misses), splat_bytes));
    add_pixel_activity(result, job(), config_.pixel_bytes());
}

} // namespace degs::gbu
