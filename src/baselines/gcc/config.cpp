// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/config.hpp"

namespace degs::gcc {

Config::Config() {
    name = "gcc-64";
    area = {0.72, 1.97}; // DeGS, Table I: P&S; blending and SRAM
    image_buffer.bytes = 128 * 1024;
    image_buffer.state_bytes = 8;
}

void Config::describe(ConfigVisitor& visitor) {
    describe_common(visitor);
    visitor.integer("view_size", view_size, 4, 1024,
                    "px; side of the part of the image that is rendered at a time, 128 fills 128 "
                    "KB of image buffer [unverified]");
    visitor.integer("group_buffer_bytes", group_buffer_bytes, 256, 1 << 30,
                    "bytes for groups between the stages; 190 KB in all (DeGS, Table I) less the "
                    "image buffer");
    visitor.integer("splat_bytes", splat_bytes, 1, 1024,
                    "bytes per Gaussian of a group in flight; as splat records elsewhere "
                    "[assumed]");
    visitor.section("pipeline", pipeline, "what the data path computes");
    visitor.section("traffic", traffic, "record layouts of the memory streams");
    visitor.section("grouping", grouping, "Stage I: depth groups");
    visitor.section("projection", projection, "Stage II: projection of groups");
    visitor.section("colour", colour, "Stage III: mask, SH, exact order");
    visitor.section("array", array, "Stage IV: alpha and blending arrays");
    visitor.section("image_buffer", image_buffer, "pixels of the views in flight");
    visitor.section("monitor", monitor, "cancellation of finished views");
    visitor.section("memory", memory, "off-chip memory");
}

std::string Config::problem() const {
    if (tile_contexts() < 1) {
        return "image_buffer.bytes / image_buffer.state_bytes holds " +
               std::to_string(image_buffer.bytes / image_buffer.state_bytes) +
               " pixels, but a view of view_size = " + std::to_string(view_size) + " has " +
               std::to_string(view_size * view_size);
    }
    constexpr int kMostViews = 4096;
    if (tile_contexts() > kMostViews) {
        return "image_buffer.bytes holds " + std::to_string(tile_contexts()) +
               " views of view_size = " + std::to_string(view_size) + "; at most " +
               std::to_string(kMostViews) + " are supported";
    }
    if (array.window * Footprint::kMaxWindows < view_size) {
        return "array.window = " + std::to_string(array.window) +
               " is too small for view_size = " + std::to_string(view_size) + ": at most " +
               std::to_string(Footprint::kMaxWindows) + " windows may lie side by side";
    }
    if (colour.block * BlockMask::kMaxBlocks < view_size) {
        return "colour.block = " + std::to_string(colour.block) +
               " is too small for view_size = " + std::to_string(view_size) + ": at most " +
               std::to_string(BlockMask::kMaxBlocks) + " blocks may lie side by side";
    }
    if (group_bytes() > group_buffer_bytes) {
        return "group_buffer_bytes = " + std::to_string(group_buffer_bytes) +
               " does not hold projection.groups_ahead x projection.group Gaussians between all "
               "stages: " +
               std::to_string(group_bytes()) + " bytes";
    }
    return "";
}

} // namespace degs::gcc
