// SPDX-License-Identifier: Apache-2.0
// The bill of materials of DeGS, and the activity of each block of it; docs/cost.md explains both.
#include "modules/degs/engine.hpp"

namespace degs {

void DegsCostRows::describe(cost::RowSection& section) {
    section.row("projection", projection, "Projection Units");
    section.row("sorting", sorting, "Sorting Units");
    section.row("span_engine", span_engine,
                "Gaussian Slicing Units and Span Units, 2 + 8, which weigh the same [assumed]");
    section.row("packing_scheduler", packing_scheduler, "Issue Banks with Packing Units");
    section.choice(
        "segment_queue", segment_queue, {"sram", "flip_flops"},
        "where masks and links of waiting segments lie: in the Packing Buffer, as part of "
        "scheduler.segment_bytes, or in flip-flops of the bank [assumed]");
    section.row("blending", blending, "Blending Array");
    section.row("gaussian_buffer", gaussian_buffer, "Gaussian Buffer");
    section.row("feature_buffer", feature_buffer, "Feature Buffer");
    section.row("span_buffer", span_buffer, "Span Buffer");
    section.row("packing_buffer", packing_buffer, "Packing Buffer");
    section.row("pixel_buffer", pixel_buffer, "Pixel Buffer");
}

void DegsConfig::describe_rows(ConfigVisitor& visitor) {
    cost::RowSection section("degs", "rows of DeGS (paper Table I)", cost, visitor);
    cost_rows.describe(section);
    section.end();
}

cost::BillOfMaterials DegsConfig::bill() const {
    const DegsCostRows& rows = cost_rows;
    const cost::LogicLaws& laws = cost.logic;
    const auto shape = [](const BankedSramPorts& ports) {
        return cost::SramShape{ports.ports, ports.sram_banks};
    };
    constexpr int kReadAndWritten = 2;
    const std::int64_t many = clusters;

    cost::BillOfMaterials bill(cost, clock_ghz);
    const double arithmetic = projection.arithmetic(pipeline.rules.projection);
    bill.add_units({"projection", "Projection Units.", true}, rows.projection, projection.count, 1,
                   {arithmetic, arithmetic});
    bill.add_units({"sorting", "Sorting Units.", true}, rows.sorting, sorting.count);
    bill.add_units({"slicing", "Gaussian Slicing Units."}, rows.span_engine,
                   clusters * slicing.count);
    bill.add_units({"span", "Span Units; one for each row that a unit takes per cycle."},
                   rows.span_engine, clusters * span.count * span.rows_per_cycle);
    bill.add_units({"packing", "Issue Banks with their Packing Units."}, rows.packing_scheduler,
                   clusters * scheduler.banks, bank_ratio());
    bill.add_units({"blending", "PEs of the Blending Array."}, rows.blending, pes(), 1,
                   cost.pe_factors(pipeline.precision()));
    bill.add_sram({"gaussian_buffer", "Sorted splats and lists being sorted."},
                  rows.gaussian_buffer, many * gaussian_buffer.bytes,
                  kReadAndWritten * (clusters * slicing.count * traffic.splat_bytes +
                                     sorting.count * traffic.list_entry_bytes),
                  shape(gaussian_buffer.ports));
    add_binning(bill, rows.gaussian_buffer, cost::SramShape{});
    if (spans_cross()) {
        bill.add_units({"span_crossbar", "Rows to any Span Unit, and its spans to any bank."},
                       laws.pe, clusters * span.count, laws.share_of(span_crossbar_area()));
    }
    if (clusters > 1) {
        bill.add_units({"cluster_dispatch", "Requests and pixels of the clusters to one memory."},
                       laws.pe, clusters, laws.share_of(cluster_dispatch_area()));
    }
    if (front.built()) {
        const int moved = front.splats_per_cycle != 0 ? front.splats_per_cycle
                                                      : clusters * fetchers() * fetching.chunk;
        bill.add_sram({"splat_supply", "FIFOs, windows and cache of the Splat Supply."},
                      rows.gaussian_buffer, front.bytes(clusters, fetchers(), traffic.splat_bytes),
                      kReadAndWritten * moved * traffic.splat_bytes, {});
    }
    bill.add_sram({"feature_buffer", "Parameters of the splats in the banks."}, rows.feature_buffer,
                  many * feature_buffer.bytes,
                  kReadAndWritten * clusters * scheduler.banks * feature_buffer.entry_bytes,
                  shape(feature_buffer.fill.ports));
    bill.add_sram({"span_buffer", "Rows of splats on their way to the Span Units."},
                  rows.span_buffer, many * span_buffer.bytes,
                  kReadAndWritten * clusters * span.count * span.rows_per_cycle *
                      span_buffer.row_bytes,
                  {span_buffer.ports.ports});
    bill.add_sram({"packing_buffer", "Waiting segments, and packets."}, rows.packing_buffer,
                  many * packing.bytes,
                  kReadAndWritten * clusters * scheduler.banks *
                      (packet_bytes() + scheduler.segment_bytes),
                  segment_shape());
    bill.add_sram({"pixel_buffer", "State of the pixels of the tiles in flight."},
                  rows.pixel_buffer, many * pixel_buffer.bytes,
                  kReadAndWritten * pes() * pixel_bytes(), shape(pixel_buffer.ports));
    return bill;
}

BankShape DegsConfig::bank_shape() const {
    BankShape shape;
    const int tiles = streams() == 1 ? scheduler.tiles_of(contexts()) : contexts();
    shape.domains =
        tiles * Segmenter::domains_per_tile(tile_size, scheduler.segment_length, scheduler.banks);
    shape.depth = queue_depth();
    shape.cut = packing.segment_ports.of(scheduler.segments_per_cycle);
    shape.issued = packing.segment_ports.of(scheduler.issue_width);
    shape.packets = packing.packets_per_cycle;
    shape.select_cycles = scheduler.select_cycles;
    shape.length = scheduler.segment_length;
    shape.width = array.pes_per_bank;
    shape.scan = scheduler.scan;
    shape.memory = cost_rows.segment_queue;
    return shape;
}

// Table I is of the design that the defaults are.
double DegsConfig::bank_ratio() const {
    if (!cost.logic.widths) {
        return 1;
    }
    DegsConfig table;
    table.cost_rows.segment_queue = cost_rows.segment_queue;
    const double published = table.bank_shape().area(cost.logic);
    return published > 0 ? bank_shape().area(cost.logic) / published : 1; // laws may be all zero
}

// Waiting segments have as many ports as are cut or issued in a cycle, unless a key says how many.
cost::SramShape DegsConfig::segment_shape() const {
    const BankShape bank = bank_shape();
    const bool wide = cost.logic.widths && bank.memory == QueueMemory::Sram;
    const int needed = wide ? std::max(bank.cut, bank.issued) : 0;
    cost::SramShape shape;
    shape.ports = packing.segment_ports.limited() ? packing.segment_ports.ports : needed;
    shape.share =
        packing.segment_ports.limited()
            ? 1
            : rate_of(std::int64_t{queue_depth()} * scheduler.segment_bytes, packing_share());
    return shape;
}

// The share of a Span Unit: it takes from any lane, and the banks take from it.
double DegsConfig::span_crossbar_area() const {
    constexpr int kBitsPerByte = 8;
    const int units = span.count * span.rows_per_cycle;
    const int taken = span.crossbar_width == 0 ? scheduler.segments_per_cycle : span.crossbar_width;
    const cost::LogicLaws& laws = cost.logic;
    return (laws.area_crossbar(span_lanes() * streams(), units,
                               kBitsPerByte * span_buffer.row_bytes) +
            laws.area_crossbar(units, scheduler.banks * taken,
                               kBitsPerByte * scheduler.segment_bytes)) /
           span.count;
}

// The share of a cluster: a request of any fetcher is chosen per cycle, and a burst of pixels.
double DegsConfig::cluster_dispatch_area() const {
    constexpr int kBitsPerByte = 8;
    const int requesters = clusters * fetchers();
    const cost::LogicLaws& laws = cost.logic;
    return (laws.area_in_turn(requesters, 1, false) +
            laws.area_crossbar(requesters, 1, laws.address_bits) +
            laws.area_crossbar(clusters, 1, kBitsPerByte * traffic.burst_bytes)) /
           clusters;
}

std::vector<cost::Activity> DegsConfig::activity(const DegsWork& work) const {
    const double segments = 2 * work.segments_issued + work.segments_dropped;
    std::vector<cost::Activity> activity{
        {"slicing", work.slicing_cycles},
        {"span", work.rows * span.cycles_per_row},
        {"packing", work.issue_cycles},
        {"blending", work.slots},
        {"gaussian_buffer", (work.splats_fetched + work.splats_sliced) * traffic.splat_bytes +
                                work.keys_moved * traffic.list_entry_bytes},
        {"feature_buffer", (work.segments_issued + work.features) * feature_buffer.entry_bytes},
        {"span_buffer", (work.rows_sent + work.rows) * span_buffer.row_bytes},
        {"packing_buffer", segments * scheduler.segment_bytes + 2 * work.packets * packet_bytes()}};
    if (spans_cross()) {
        activity.push_back({"span_crossbar", work.rows});
    }
    if (clusters > 1) {
        activity.push_back({"cluster_dispatch", work.splats_fetched});
    }
    if (front.built()) {
        activity.push_back({"splat_supply", work.supplied * traffic.splat_bytes});
    }
    return activity;
}

void Degs::collect_activity(AcceleratorResult& result) const {
    using G = GaussianSlicingUnit::Stats;
    using S = SpanStage::Stats;
    using B = IssueBank::Stats;
    DegsWork work;
    work.slicing_cycles = real_of(sum_of(blocks_.slicing, &G::busy));
    work.issue_cycles = real_of(sum_of(blocks_.banks, &B::busy));
    work.splats_fetched = real_of(sum_of(blocks_.fetchers, &SplatFetcher::Stats::records));
    work.splats_sliced = real_of(sum_of(blocks_.slicing, &G::splats));
    work.keys_moved = real_of(front_end_->keys_moved());
    work.supplied = supply_ ? real_of(supply_->stats().records_moved()) : 0;
    work.rows_sent = real_of(sum_of(blocks_.slicing, &G::rows));
    work.rows = real_of(sum_of(blocks_.spans, &S::rows));
    for (const auto& bank : blocks_.banks) {
        work.features += real_of(bank->features().stats().entries);
    }
    work.segments_issued = real_of(sum_of(blocks_.banks, &B::segments_issued));
    work.segments_dropped = real_of(sum_of(blocks_.banks, &B::segments_dropped));
    work.packets = real_of(sum_of(blocks_.packing, &PackingUnit::Stats::packets));
    work.slots = real_of(result.slots.executed());
    add_activity(result, config_.activity(work));
    add_pixel_activity(result, job_, config_.pixel_bytes());
}

} // namespace degs
