// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/config.hpp"

#include "tlm/ceil_div.hpp"

namespace degs::gcc {

Config::Config() {
    name = "gcc-64";
    image_buffer.bytes = 128 * 1024;
    image_buffer.state_bytes = 8;
}

void Config::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.integer("clusters", clusters, 1, 64,
                    "Stages II to IV, each with the buffers below and on a view of its own, behind "
                    "one Stage I; beyond the paper");
    visitor.integer("view_size", view_size, 4, 1024,
                    "px; side of the part of the image that is rendered at a time [unverified]");
    visitor.integer("group_buffer_bytes", group_buffer_bytes, 256, 1 << 30,
                    "bytes for groups between the stages; 190 KB in all (DeGS, Table I) less the "
                    "image buffer");
    visitor.integer("splat_bytes", splat_bytes, 1, 1024,
                    "bytes per Gaussian of a group in flight; as splat records elsewhere "
                    "[assumed]");
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    TrafficConfig records = traffic.common();
    pipeline.describe_records(visitor, records);
    traffic.formats.set_formats(pipeline.stored_numbers());
    require_parts(visitor);
    visitor.section("grouping", grouping, "Stage I: depth groups");
    visitor.section("projection", projection, "Stage II: projection of groups");
    visitor.section("colour", colour, "Stage III: mask, SH, exact order");
    visitor.section("array", array, "Stage IV: alpha and blending arrays");
    visitor.section("image_buffer", image_buffer, "pixels of the views in flight");
    visitor.section("monitor", monitor, "cancellation of finished views");
    visitor.section("memory", memory, "off-chip memory");
    describe_cost(visitor);
    require_sizes(visitor);
}

/// Stages read parts of a Gaussian that hold its formats.
void Config::require_parts(ConfigVisitor& visitor) const {
    const ProjectionNumbers stored = pipeline.stored_numbers();
    const auto require = [&](const char* key, const char* what, int bytes, int bits) {
        const std::string least = std::to_string(ceil_div(bits, 8));
        visitor.require(bytes == 0 || 8 * bytes >= bits,
                        {key,
                         std::string("must hold ") + what + ", " + least + " B",
                         least,
                         {"pipeline.records", "pipeline.numbers"}});
    };
    require("traffic.mean_bytes", "the mean of a Gaussian", traffic.mean_bytes, stored.mean_bits());
    require("traffic.shape_bytes", "scale, rotation and opacity of a Gaussian", traffic.shape_bytes,
            stored.shape_bits());
}

void Config::require_sizes(ConfigVisitor& visitor) const {
    constexpr int kMostViews = 4096;
    image_buffer.require_tiles(visitor, "image_buffer", view_pixels(), 1, {"view_size", "clusters"},
                               kMostViews / clusters);
    visitor.require_at_least(
        "array.window", array.window, ceil_div(view_size, Footprint::kMaxWindows),
        "so that at most 64 windows lie side by side in a view", {"view_size"});
    visitor.require_at_least("colour.block", colour.block,
                             ceil_div(view_size, BlockMask::kMaxBlocks),
                             "so that at most 64 blocks lie side by side in a view", {"view_size"});
    visitor.require_at_least(
        "group_buffer_bytes", group_buffer_bytes, group_bytes(),
        "to hold projection.groups_ahead groups between all stages",
        {"projection.groups_ahead", "projection.group", "splat_bytes", "traffic.list_entry_bytes"});
}

} // namespace degs::gcc
