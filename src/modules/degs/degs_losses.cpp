// SPDX-License-Identifier: Apache-2.0
// What moves the losses of DeGS.
#include "modules/degs/degs_config.hpp"

namespace degs {

// The Packing Buffer holds the waiting segments, as many as it has room for if queue_segments_per_pe is 0, and the
// packets, up to lead_packets.
std::vector<LossKey> DegsConfig::loss_keys() const {
    using Way = LossKey::Way;
    std::vector<LossKey> keys{
        {"slicing", "slicing.count", Way::Raise, "64"},
        {"slicing", "slicing.splats_per_cycle", Way::Raise, "16"},
        {"span", "span.count", Way::Raise, "256"},
        {"packing", "scheduler.issue_width", Way::Raise, kNoLimit},
        {"packing", "scheduler.segments_per_cycle", Way::Raise, kNoLimit},
        {"boundary", "pipeline.span_ends", Way::Set, "exact"},
        {"boundary", "span.parsing", Way::Set, "true"},
        {"terminated", "scheduler.termination", Way::Set, "pixel"},
        {"ports", "pixel_buffer.sram_banks", Way::Raise, kNoLimit},
        {"ports", "packing.ports", Way::Set, "0"},
        {"blocked", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
        {"blocked", "pixel_buffer.bytes", Way::Raise, kNoLimit},
        {"readout", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
    };
    if (spans_are_pooled()) {
        keys.push_back({"span", "span.rows_per_cycle", Way::Raise, "64"});
    }
    const bool fill_buffer = scheduler.queue_segments_per_pe == 0;
    for (const char* cause : {"gaps", "conflict"}) {
        keys.push_back({cause, "slicing.interleave", Way::Raise, "16"});
        if (fill_buffer) {
            keys.push_back({cause, "packing.bytes", Way::Raise, kNoLimit});
        } else {
            keys.push_back({cause, "scheduler.queue_segments_per_pe", Way::Raise, "256"});
        }
    }
    keys.push_back(
        {"conflict", "scheduler.reuse_cycles", Way::Lower, "1", "array.writeback_cycles"});
    keys.push_back({"conflict", "tile_size", Way::Raise, "1024", "pixel_buffer.bytes"});
    if (packing_depth() < packing.lead_packets) {
        keys.push_back({"full", "packing.bytes", Way::Raise, kNoLimit});
    } else {
        keys.push_back({"full", "packing.lead_packets", Way::Raise, "65536"});
    }
    return with(keys, common_loss_keys(memory));
}

} // namespace degs
