// SPDX-License-Identifier: Apache-2.0
#include "config.hpp"

#include "modules/kit/job/family_size.hpp"
#include "tlm/ceil_div.hpp"

namespace degs::row_sweep {

Config::Config() {
    name = "row-sweep-64";
    pixel_buffer.bytes = 8 * 1024; // two tiles of 16 x 16 px
}

void Config::Buffer::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 256, 1 << 30,
                    "bytes in front of an array: splats and lists being sorted");
    visitor.integer("chunks", chunks, 1, 1024, "chunks of splats in front of an array");
}

void Config::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.integer("tile_size", tile_size, 4, 32, "px, and PEs of an array");
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    pipeline.describe_records(visitor, traffic);
    visitor.section("projection", projection, "projection units");
    visitor.section("binning", binning, "tile lists");
    visitor.section("sorting", sorting, "hierarchical sorting units");
    visitor.section("fetching", fetching, "Splat Fetchers, one per array");
    visitor.section("buffer", buffer, "on-chip memory in front of an array");
    visitor.section("arrays", arrays, "arrays that sweep over splats");
    visitor.section("pixel_buffer", pixel_buffer, "tiles in flight of one array");
    visitor.section("monitor", monitor, "cancellation of finished tiles");
    visitor.section("memory", memory, "off-chip memory");
    describe_cost(visitor);
    pixel_buffer.require_tiles(visitor, "pixel_buffer", tile_pixels(), 1,
                               {"tile_size", "arrays.count"}, kMostContexts / arrays.count);
    visitor.require_at_least(
        "buffer.bytes", buffer.bytes,
        chunks_bytes() +
            ceil_div(std::int64_t{sorting.count} * sorting.chunk * traffic.list_entry_bytes,
                     arrays.count),
        "to hold its chunks of splats, and a share of a chunk of list entries for every sorting "
        "unit",
        {"buffer.chunks", "fetching.chunk", "sorting.count", "sorting.chunk", "arrays.count"});
}

void Config::scale_to(int pes) {
    constexpr int kMost = 1024;
    require_family_size("row_sweep", pes, kMost, "must be a multiple of 16",
                        [this](int number) { return number % tile_size == 0; });
    name = "row-sweep-" + std::to_string(pes);
    arrays.count = pes / tile_size;
}

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    return with(
        {
            {"terminated", "arrays.skip_ended", Way::Set, "", "true"},
            {"answers", "fetching.chunks_in_flight", Way::Raise, "buffer.chunks"},
            {"blocked", "pixel_buffer.bytes", Way::Raise},
            {"blocked", "pixel_buffer.readout_pixels", Way::Raise},
            {"acknowledgements", "pixel_buffer.writes_in_flight", Way::Raise},
            {"acknowledgements", "pixel_buffer.bytes", Way::Raise},
            {"readout", "pixel_buffer.readout_pixels", Way::Raise},
        },
        common_loss_keys(memory));
}

void Config::describe_rows(ConfigVisitor& visitor) {
    cost::RowSection section("row_sweep", "rows of the row sweep", cost, visitor);
    section.row("projection", cost_rows.projection, "projection units");
    section.row("sorting", cost_rows.sorting, "sorting units");
    section.row("blending", cost_rows.blending, "PEs of the arrays");
    section.row("sram", cost_rows.sram, "all buffers");
    section.end();
}

cost::BillOfMaterials Config::bill() const {
    constexpr int kReadAndWritten = 2;
    const std::int64_t count = arrays.count;
    cost::BillOfMaterials bill(cost, clock_ghz);
    bill.add_units({"projection", "Projection units.", true}, cost_rows.projection,
                   projection.count);
    bill.add_units({"sorting", "Hierarchical sorting units.", true}, cost_rows.sorting,
                   sorting.count);
    bill.add_units({"blending", "PEs of the arrays."}, cost_rows.blending, pes(), 1,
                   cost.pe_factors(pipeline.precision()));
    bill.add_sram({"gaussian_buffer", "Splats and lists being sorted."}, cost_rows.sram,
                  count * buffer.bytes,
                  kReadAndWritten * (arrays.count * traffic.splat_bytes +
                                     sorting.count * traffic.list_entry_bytes));
    add_binning(bill, cost_rows.sram);
    bill.add_sram({"pixel_buffer", "State of the pixels of the tiles in flight."}, cost_rows.sram,
                  count * pixel_buffer.bytes, kReadAndWritten * pes() * pixel_bytes());
    return bill;
}

} // namespace degs::row_sweep
