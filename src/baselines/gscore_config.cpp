// SPDX-License-Identifier: Apache-2.0
#include "baselines/gscore_config.hpp"

namespace degs {

void GscoreConfig::Buffer::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 256, 1 << 30,
                    "bytes in all, pixel_buffer.bytes included (paper Table I: 8 x 34 KB)");
    visitor.real("sort_share", sort_share, 0.05, 0.95,
                 "share of what the Pixel Buffer leaves for lists being sorted; the rest holds "
                 "sorted splats [assumed]");
}

GscoreConfig::GscoreConfig() {
    name = "gscore-64";
    area = {0.89, 3.06}; // paper, Table I: P&S, and blending with SRAM
    projection.latency_cycles = 128;
    traffic.geometry_bytes = 44;
    traffic.sh_value_bytes = 4;
    traffic.sh = ShReads::All;
    pixel_buffer.bytes = 8 * 1024; // two tiles of 16 x 16 px
}

void GscoreConfig::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    visitor.section("projection", projection, "culling and conversion units");
    visitor.section("binning", binning, "tile lists");
    visitor.section("sorting", sorting, "hierarchical sorting units");
    visitor.section("fetching", fetching, "Splat Fetchers, one per sorting unit");
    visitor.section("buffer", buffer, "on-chip memory");
    visitor.section("array", array, "volume rendering cores");
    visitor.section("pixel_buffer", pixel_buffer, "tiles in flight, part of buffer.bytes");
    visitor.section("monitor", monitor, "cancellation of finished tiles");
    visitor.section("memory", memory, "off-chip memory");
}

int GscoreConfig::splat_chunks() const {
    const double share =
        (1.0 - buffer.sort_share) * (buffer.bytes - pixel_buffer.bytes) / sorting.count;
    return static_cast<int>(share) / (traffic.splat_bytes * fetching.chunk);
}

int GscoreConfig::sort_capacity() const {
    const double share = buffer.sort_share * (buffer.bytes - pixel_buffer.bytes) / sorting.count;
    return static_cast<int>(share) / traffic.list_entry_bytes;
}

std::string GscoreConfig::problem() const {
    const auto need = [](const std::string& what, int has, int least) {
        return what + " holds " + std::to_string(has) + ", but at least " + std::to_string(least) +
               " must fit";
    };
    if (const std::string why = pixel_buffer.problem(tile_size_px()); !why.empty()) {
        return why;
    }
    if (pixel_buffer.bytes > buffer.bytes) {
        return "pixel_buffer.bytes = " + std::to_string(pixel_buffer.bytes) +
               " is part of buffer.bytes = " + std::to_string(buffer.bytes) + " and cannot be more";
    }
    if (splat_chunks() < 1) {
        return need("buffer.bytes per sorting unit in chunks of fetching.chunk splats",
                    splat_chunks(), 1);
    }
    if (sort_capacity() < sorting.chunk) {
        return need("buffer.bytes x sort_share per sorting unit in list entries", sort_capacity(),
                    sorting.chunk);
    }
    return "";
}

} // namespace degs
