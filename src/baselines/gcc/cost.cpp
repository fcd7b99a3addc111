// SPDX-License-Identifier: Apache-2.0
// The bill of materials of GCC, and the activity of each block of it; docs/cost.md explains both.
#include "baselines/gcc/engine.hpp"

namespace degs::gcc {
namespace {

/// Rings that a Gaussian passes before it has a colour, and those that it passes with one.
constexpr int kRingsOfShapes = 2, kRingsOfColours = 2;
constexpr int kReadAndWritten = 2;

} // namespace

void CostRows::describe(cost::RowSection& section) {
    section.row("preprocessing", preprocessing,
                "P & S: 4 lanes of Stage I, 4 projection units and 4 SH units, which weigh the "
                "same [assumed]");
    section.row("blending", blending, "PEs of the window");
    section.row("sram", sram, "all buffers");
}

void Config::describe_rows(ConfigVisitor& visitor) {
    cost::RowSection section("gcc", "rows of GCC (paper Table I)", cost, visitor);
    cost_rows.describe(section);
    section.end();
}

cost::BillOfMaterials Config::bill() const {
    const CostRows& rows = cost_rows;
    const int records = kRingsOfShapes * projection.units + kRingsOfColours * colour.units;
    cost::BillOfMaterials bill(cost, clock_ghz);
    bill.add_units({"grouping", "Lanes of Stage I, a mean per cycle each.", true},
                   rows.preprocessing, grouping.means_per_cycle);
    bill.add_units({"projection", "Projection units of Stage II.", true}, rows.preprocessing,
                   clusters * projection.units);
    bill.add_units({"colour", "SH units of Stage III, with its sorter.", true}, rows.preprocessing,
                   clusters * colour.units);
    bill.add_units({"blending", "PEs of the window."}, rows.blending, pes(), 1,
                   cost.pe_factors(pipeline.precision()));
    bill.add_sram({"group_buffer", "Groups of Gaussians between the stages."}, rows.sram,
                  std::int64_t{clusters} * group_buffer_bytes,
                  clusters * kReadAndWritten *
                      (records * splat_bytes + projection.units * traffic.list_entry_bytes));
    bill.add_sram({"pixel_buffer", "State of the pixels of the views in flight."}, rows.sram,
                  std::int64_t{clusters} * image_buffer.bytes,
                  kReadAndWritten * pes() * pixel_bytes());
    return bill;
}

void Engine::collect_activity(AcceleratorResult& result) const {
    std::uint64_t entries = 0;
    std::uint64_t records = 0; // through one ring each
    if (grouping_) {
        const std::uint64_t shapes = sum_of(projection_, &ProjectionStage::Stats::shapes);
        const std::uint64_t coloured = sum_of(colour_, &ColourStage::Stats::coloured);
        add_activity(result, "grouping", grouping_->stats().gaussians);
        add_activity(result, "projection", shapes * config_.projection.cycles_per_gaussian);
        add_activity(result, "colour", coloured * config_.colour.cycles_per_colour);
        entries = sum_of(projection_, &ProjectionStage::Stats::entries);
        records = kRingsOfShapes * shapes + kRingsOfColours * coloured;
    } else {
        records = sum_of(fetchers_, &SplatFetcher::Stats::records);
    }
    add_activity(result, "blending", result.slots.executed());
    add_activity(result, "group_buffer",
                 kReadAndWritten * (rate_of(entries, 1) * config_.traffic.list_entry_bytes +
                                    rate_of(records, 1) * config_.splat_bytes));
    add_pixel_activity(result, job_, config_.pixel_bytes());
}

} // namespace degs::gcc
