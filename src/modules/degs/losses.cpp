// SPDX-License-Identifier: Apache-2.0
// Names the keys that would reduce each loss of PE-cycles of a DeGS design.
#include "modules/degs/config.hpp"

namespace degs {
namespace {

constexpr const char* kFeatures = "feature_buffer.bytes";
// A splat waits for its entry of the Feature Buffer so rarely that more entries would not help.
constexpr double kRare = 0.02;
constexpr const char* kTakes = "scheduler.segments_per_cycle";
constexpr const char* kIssues = "scheduler.issue_width";

} // namespace

// The Packing Buffer holds the waiting segments, as many as it has room for if
// queue_segments_per_pe is 0. It holds the packets, too, but no number of them keeps the array
// waiting: it executes one in every cycle in which one waits.
std::vector<LossKey> DegsConfig::loss_keys() const {
    using Way = LossKey::Way;
    std::vector<LossKey> keys{
        {"slicing", "slicing.count", Way::Raise},
        {"slicing", "slicing.splats_per_cycle", Way::Raise},
        {"span", "span.count", Way::Raise},
        {"terminated", "scheduler.termination", Way::Set, "", "pixel"},
        {"ports", "pixel_buffer.sram_banks", Way::Raise},
        {"ports", "packing.ports", Way::Set, "", "0"},
        {"blocked", "pixel_buffer.readout_pixels", Way::Raise},
        {"blocked", "pixel_buffer.bytes", Way::Raise},
        {"acknowledgements", "pixel_buffer.writes_in_flight", Way::Raise},
        {"acknowledgements", "pixel_buffer.bytes", Way::Raise},
        {"readout", "pixel_buffer.readout_pixels", Way::Raise},
    };
    keys.push_back(span.parsing ? LossKey{"boundary", "pipeline.span_ends", Way::Set, "", "exact"}
                                : LossKey{"boundary", "span.parsing", Way::Set, "", "true"});
    if (spans_are_pooled()) {
        keys.push_back({"span", "span.rows_per_cycle", Way::Raise});
    }
    // A cluster among others is granted tiles one by one, and waits for the first chunk of each.
    if (clusters == 1) {
        keys.push_back(
            {"answers", "fetching.chunks_in_flight", Way::Raise, "gaussian_buffer.bytes"});
    }
    // A bank issues no more than it takes in.
    const int ahead = scheduler.segments_per_cycle - scheduler.issue_width;
    keys.push_back(ahead == 0 ? LossKey{"packing", kIssues, Way::Raise, kTakes}
                              : LossKey{"packing", ahead < 0 ? kTakes : kIssues, Way::Raise});
    const char* const queue = queue_key();
    for (const char* cause : {"gaps", "conflict"}) {
        keys.push_back({cause, "slicing.interleave", Way::Raise});
        keys.push_back({cause, queue, Way::Raise});
        keys.push_back({cause, queue, Way::Raise, kFeatures});
    }
    keys.push_back({"conflict", "scheduler.reuse_cycles", Way::Lower, "array.writeback_cycles"});
    return with(keys, common_loss_keys(memory));
}

const char* DegsConfig::queue_key() const {
    return scheduler.queue_segments_per_pe == 0 ? "packing.bytes"
                                                : "scheduler.queue_segments_per_pe";
}

// More waiting segments need more splats in the Feature Buffer: what has no entry cannot wait.
std::vector<std::string> DegsConfig::idle_window_keys(std::uint64_t high_water,
                                                      double feature_waits) const {
    const bool queue_was_full = high_water >= static_cast<std::uint64_t>(queue_depth());
    const bool features_were = feature_waits > kRare;
    const std::string queue = queue_key();
    std::vector<std::string> idle;
    if (!queue_was_full || features_were) {
        idle.push_back(queue);
    }
    if (!queue_was_full || !features_were) {
        idle.push_back(queue + " and " + kFeatures);
    }
    return idle;
}

} // namespace degs
