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
    const double arithmetic = projection.arithmetic(pipeline.rules.projection);
    bill.add_units({"projection", "Projection units of Stage II.", true}, rows.preprocessing,
                   clusters * projection.units, 1, {arithmetic, arithmetic});
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

std::vector<cost::Activity> Config::activity(const Work& work, bool array_only) const {
    std::vector<cost::Activity> activity;
    if (!array_only) {
        activity = {
            {"grouping", work.means},
            {"projection", work.shapes * projection.project_cycles(pipeline.rules.projection)},
            {"colour", work.coloured * colour.cycles_per_colour}};
    }
    const double records = // through one ring each
        kRingsOfShapes * work.shapes + kRingsOfColours * work.coloured + work.records_fetched;
    activity.push_back({"blending", work.slots});
    activity.push_back({"group_buffer", kReadAndWritten * (work.entries * traffic.list_entry_bytes +
                                                           records * splat_bytes)});
    return activity;
}

void Engine::collect_activity(AcceleratorResult& result) const {
    Work work;
    if (grouping_) {
        work.means = real_of(grouping_->stats().gaussians);
        work.entries = real_of(sum_of(projection_, &ProjectionStage::Stats::entries));
        work.shapes = real_of(sum_of(projection_, &ProjectionStage::Stats::shapes));
        work.coloured = real_of(sum_of(colour_, &ColourStage::Stats::coloured));
    } else {
        work.records_fetched = real_of(sum_of(fetchers_, &SplatFetcher::Stats::records));
    }
    work.slots = real_of(result.slots.executed());
    add_activity(result, config_.activity(work, !grouping_));
    add_pixel_activity(result, job_, config_.pixel_bytes());
}

} // namespace degs::gcc
