// SPDX-License-Identifier: Apache-2.0
#include "baselines/orange/config.hpp"

#include "splat/pixels/quantized_gemm.hpp"
#include "tlm/ceil_div.hpp"

namespace degs::orange {

Config::Config() {
    name = "orange-o4";
    projection.latency_cycles = 128;
    fetching.chunk = 256;
    fetching.chunks_in_flight = 2;
    pixel_buffer.bytes = 8 * 1024; // two tiles of 8 x 8 px for each core
    pixel_buffer.readout_pixels = 256;
}

Config::Gemm::Gemm() : ExponentGemm(half_precision_gemm(GemmOrigin::Tile)) {}

void Config::Gemm::describe(ConfigVisitor& visitor) {
    visitor.choice("origin", origin, {"tile", "image"},
                   "origin of the pixels' monomials; tile: the middle of each tile; image: its "
                   "first pixel, with coefficients that serve all tiles and cancel far from it");
    describe_format(visitor, "operands", operands,
                    "coefficients and monomials; of number sets, fp32 and fp64 multiply their own");
    describe_format(visitor, "sums", sums, "products and their sums, likewise");
}

void Config::Cores::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 256,
                    "cores, each on a tile of its own (ORANGE: 1 to 4, O-4)");
    visitor.section("array", array, "systolic array of a core");
    visitor.section("vector", vector, "vector unit of a core");
}

void Config::Scratchpad::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 1024, 1 << 30,
                    "bytes of a core: batches on their way and lists being sorted [assumed]");
    visitor.integer("splat_batches", splat_batches, 1, 1024, "batches of splat records [assumed]");
    visitor.integer("coefficient_batches", coefficient_batches, 1, 1024,
                    "batches of coefficients and colours in front of the array [assumed]");
    visitor.integer("product_batches", product_batches, 1, 1024,
                    "products in front of the vector unit [assumed]");
    visitor.integer("value_bytes", value_bytes, 1, 8,
                    "bytes of a coefficient, a colour and an exponent [assumed]");
}

void Config::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.integer("tile_size", tile_size, 4, 32, "px (ORANGE: 8)");
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("gemm", gemm, "the product of matrices that forms exponents");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    pipeline.describe_records(visitor, traffic);
    visitor.section("projection", projection,
                    "projection, at the rate of GSCore's units; it does not compete for the vector "
                    "units [assumed]");
    visitor.section("binning", binning, "tile lists");
    visitor.section("sorting", sorting,
                    "sorting, at the rate of GSCore's units; ORANGE sorts on its vector units "
                    "[assumed]");
    visitor.section("fetching", fetching, "Splat Fetchers, one per core; a chunk is a batch");
    visitor.section("cores", cores, "cores");
    visitor.section("scratchpad", scratchpad, "memory of a core");
    visitor.section("pixel_buffer", pixel_buffer, "tiles in flight");
    visitor.section("monitor", monitor, "cancellation of finished tiles");
    visitor.section("memory", memory, "off-chip memory");
    describe_cost(visitor);
    require_sizes(visitor);
}

TileCoupling Config::tile_coupling(bool /*array_only*/) const {
    if (cores.count == 1) {
        return {};
    }
    return {"The cores of this design compete for memory while each has a tile of its own",
            "cores.count=1"};
}

DataPathOptions Config::data_path() const {
    DataPathOptions options = pipeline.data_path();
    options.gemm = gemm;
    return options;
}

std::int64_t Config::splat_batch_bytes() const {
    return std::int64_t{fetching.chunk} * traffic.splat_bytes;
}

std::int64_t Config::coefficient_batch_bytes() const {
    constexpr int kColours = 3;
    return std::int64_t{fetching.chunk} * (kGemmDepth + kColours) * scratchpad.value_bytes;
}

std::int64_t Config::product_batch_bytes() const {
    return std::int64_t{fetching.chunk} * tile_area() * scratchpad.value_bytes;
}

std::int64_t Config::batches_bytes() const {
    return scratchpad.splat_batches * splat_batch_bytes() +
           scratchpad.coefficient_batches * coefficient_batch_bytes() +
           scratchpad.product_batches * product_batch_bytes();
}

int Config::sort_capacity() const {
    const std::int64_t left = cores.count * (scratchpad.bytes - batches_bytes());
    return static_cast<int>(left / sorting.count / traffic.list_entry_bytes);
}

void Config::require_sizes(ConfigVisitor& visitor) const {
    pixel_buffer.require_tiles(visitor, "pixel_buffer", tile_pixels(), cores.count,
                               {"tile_size", "cores.count"});
    const std::int64_t list = ceil_div(
        std::int64_t{sorting.count} * sorting.chunk * traffic.list_entry_bytes, cores.count);
    visitor.require_at_least(
        "scratchpad.bytes", scratchpad.bytes, batches_bytes() + list,
        "to hold the batches of a core and its share of a chunk of list entries for every sorting "
        "unit",
        {"fetching.chunk", "scratchpad.product_batches", "tile_size"});
}

} // namespace degs::orange
