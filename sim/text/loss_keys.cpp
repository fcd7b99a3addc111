// SPDX-License-Identifier: Apache-2.0
#include "sim/text/loss_keys.hpp"

#include <algorithm>
#include <cmath>

#include "config/config_document.hpp"
#include "config/config_source.hpp"
#include "config/error.hpp"
#include "modules/degs_config.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {

enum class Way { Raise, Lower, Set };

/// A key moves a loss until it has come to `limit`: a number, or the value to set. Of several keys the
/// one that moves most on close-ups stands first. A key that shrinks the array is none: it makes a
/// frame longer.
struct LossKey {
    const char* accelerator; ///< empty: all
    const char* cause;
    const char* key;
    Way way;
    const char* limit;
    const char* linked = ""; ///< key that has to move with it
};

namespace {

constexpr const char* kMost = "1e9"; // no limit but the key's range

constexpr LossKey kLossKeys[] = {
    {"", "memory", "memory.bandwidth_gb_per_s", Way::Raise, "100000"},
    {"", "memory", "memory.lpddr5.channels", Way::Raise, "64"},
    {"", "latency", "memory.latency_ns", Way::Lower, "0"},
    {"", "projection", "projection.count", Way::Raise, "64"},
    {"gcc", "projection", "projection.units", Way::Raise, kMost},
    {"gcc", "colour", "colour.units", Way::Raise, kMost},
    {"gcc", "grouping", "grouping.means_per_cycle", Way::Raise, kMost},
    {"gcc", "grouping", "grouping.entries_per_cycle", Way::Raise, kMost},
    {"", "binning", "binning.pairs_per_cycle", Way::Raise, kMost},
    {"", "sorting", "sorting.count", Way::Raise, "64"},
    {"", "sorting", "sorting.keys_per_cycle", Way::Raise, kMost},
    {"", "fetching", "fetching.chunks_in_flight", Way::Raise, kMost},
    {"", "fetching", "sorting.count", Way::Raise, "64"},
    {"degs", "slicing", "slicing.count", Way::Raise, "64"},
    {"degs", "slicing", "slicing.splats_per_cycle", Way::Raise, "16"},
    {"degs", "span", "span.count", Way::Raise, "256"},
    {"degs", "span", "span.rows_per_cycle", Way::Raise, "64"},
    {"degs", "packing", "scheduler.issue_width", Way::Raise, kMost},
    {"degs", "packing", "scheduler.segments_per_cycle", Way::Raise, kMost},
    {"gbu", "row_generation", "engines.count", Way::Raise, kMost},
    {"gbu", "dispatch", "engines.count", Way::Raise, kMost},
    {"orange", "systolic_arrays", "cores.count", Way::Raise, "256", "pixel_buffer.bytes"},
    {"orange", "vector_units", "cores.vector.lanes", Way::Raise, "65536"},
    {"degs", "gaps", "slicing.interleave", Way::Raise, "16"},
    {"degs", "gaps", "scheduler.queue_segments_per_pe", Way::Raise, "256"},
    {"degs", "gaps", "packing.bytes", Way::Raise, kMost},
    {"gscore", "gaps", "buffer.bytes", Way::Raise, kMost},
    {"gbu", "gaps", "engines.queue_depth", Way::Raise, "4096"},
    {"gcc", "gaps", "group_buffer_bytes", Way::Raise, kMost},
    {"degs", "boundary", "pipeline.span_ends", Way::Set, "exact"},
    {"degs", "boundary", "span.parsing", Way::Set, "true"},
    {"gscore", "boundary", "array.subtile_skip", Way::Set, "exact"},
    {"gbu", "boundary", "engines.end_probe", Way::Set, "false"},
    {"degs", "terminated", "scheduler.termination", Way::Set, "pixel"},
    {"gscore", "terminated", "array.termination_cycles", Way::Lower, "1"},
    {"gbu", "terminated", "engines.termination_cycles", Way::Lower, "1"},
    {"gcc", "terminated", "array.skip_cycles", Way::Lower, "0"},
    {"degs", "conflict", "slicing.interleave", Way::Raise, "16"},
    {"degs", "conflict", "scheduler.queue_segments_per_pe", Way::Raise, "256"},
    {"degs", "conflict", "packing.bytes", Way::Raise, kMost},
    {"degs", "conflict", "scheduler.reuse_cycles", Way::Lower, "1", "array.writeback_cycles"},
    {"degs", "conflict", "tile_size", Way::Raise, "1024", "pixel_buffer.bytes"},
    {"gcc", "conflict", "array.discovery_cycles", Way::Lower, "1"},
    {"orange", "padding", "cores.array.fill", Way::Set, "none"},
    {"orange", "padding", "fetching.chunk", Way::Raise, "1024", "scratchpad.bytes"},
    {"orange", "gaps", "scratchpad.splat_batches", Way::Raise, "1024", "scratchpad.bytes"},
    {"degs", "ports", "pixel_buffer.sram_banks", Way::Raise, kMost},
    {"degs", "ports", "packing.ports", Way::Set, "0"},
    {"degs", "blocked", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
    {"degs", "blocked", "pixel_buffer.bytes", Way::Raise, kMost},
    {"degs", "full", "packing.bytes", Way::Raise, kMost},
    {"degs", "full", "packing.lead_packets", Way::Raise, "65536"},
    {"gscore", "blocked", "pixel_buffer.bytes", Way::Raise, kMost},
    {"gscore", "blocked", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
    {"gbu", "blocked", "pixel_buffer.bytes", Way::Raise, kMost},
    {"gbu", "blocked", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
    {"gcc", "blocked", "image_buffer.bytes", Way::Raise, kMost},
    {"gcc", "blocked", "image_buffer.readout_pixels", Way::Raise, "4096"},
    {"", "readout", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
    {"gcc", "readout", "image_buffer.readout_pixels", Way::Raise, "4096"},
    {"", "readout", "memory.latency_ns", Way::Lower, "0"},
};

} // namespace

LossKeys::LossKeys(const RunResult& result)
    : result_(result), config_(resolved(RunConfig(result.config))) {}

const nlohmann::ordered_json* LossKeys::value(const std::string& key) const {
    const nlohmann::ordered_json* at = &config_;
    for (std::size_t begin = 0; begin <= key.size();) {
        const std::size_t dot = std::min(key.find('.', begin), key.size());
        const auto found = at->find(key.substr(begin, dot - begin));
        if (!at->is_object() || found == at->end()) {
            return nullptr;
        }
        at = &*found;
        begin = dot + 1;
    }
    return at;
}

std::optional<double> LossKeys::number(const std::string& key) const {
    const nlohmann::ordered_json* found = value(key);
    return found != nullptr && found->is_number() && found->get<double>() > 0
               ? std::optional<double>(found->get<double>())
               : std::nullopt;
}

bool LossKeys::can_move(const LossKey& knob) const {
    const std::string key = knob.key;
    const nlohmann::ordered_json* const now = value(key);
    const bool lpddr5 = value("memory.model") != nullptr && *value("memory.model") == "lpddr5";
    if (now == nullptr || (key.rfind("memory.lpddr5", 0) == 0 && !lpddr5) ||
        (lpddr5 && (key == "memory.bandwidth_gb_per_s" || key == "memory.latency_ns"))) {
        return false;
    }
    if (result_.accelerator.array_only && key.rfind("memory.", 0) == 0) {
        return false;
    }
    if (result_.config.kind() == "degs" && !can_move_in_degs(key, knob.cause)) {
        return false;
    }
    if (knob.way == Way::Set) {
        const std::string text = now->is_string() ? now->get<std::string>() : now->dump();
        return text != knob.limit;
    }
    const double limit = std::stod(knob.limit);
    const double present = now->get<double>();
    return knob.way == Way::Raise ? present < limit : present > limit;
}

// Whether the design allows some step, a factor or its square for a linked key.
bool LossKeys::allows(const LossKey& knob) const {
    const std::string key = knob.key, linked = knob.linked;
    if (knob.way == Way::Set) {
        return allows({key + "=" + knob.limit});
    }
    const auto setting = [&](const std::string& name, double factor) {
        const double now = value(name)->get<double>();
        const double to =
            knob.way == Way::Raise ? std::max(now, 1.0) * factor : std::floor(now / factor);
        return name + "=" + as_typed(to);
    };
    for (const double factor : {2.0, 4.0, 8.0, 16.0}) {
        const std::string first = setting(key, factor);
        if (linked.empty() ? allows({first})
                           : allows({first, setting(linked, factor)}) ||
                                 allows({first, setting(linked, factor * factor)})) {
            return true;
        }
    }
    return false;
}

bool LossKeys::allows(const std::vector<std::string>& settings) const {
    RunConfig changed = result_.config;
    try {
        ConfigSource::from_overrides(settings).load(changed);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

// Keys that other keys of DeGS make idle. The Packing Buffer holds the waiting segments, as many
// as it has room for if queue_segments_per_pe is 0, and the packets, up to lead_packets.
bool LossKeys::can_move_in_degs(const std::string& key, const std::string& cause) const {
    const auto& config = dynamic_cast<const DegsConfig&>(result_.config.accelerator());
    const bool fill_buffer = config.scheduler.queue_segments_per_pe == 0;
    const bool few_packets = config.packing_depth() < config.packing.lead_packets;
    if (key == "packing.bytes") {
        return fill_buffer || (cause == "full" && few_packets);
    }
    if (key == "packing.lead_packets") {
        return !few_packets;
    }
    if (key == "scheduler.queue_segments_per_pe") {
        return !fill_buffer;
    }
    return key != "span.rows_per_cycle" || config.spans_are_pooled();
}

std::vector<std::string> LossKeys::movable() const {
    std::vector<std::string> keys;
    for (const LossKey& knob : kLossKeys) {
        const std::string accelerator = knob.accelerator;
        const bool own = accelerator.empty() || accelerator == result_.config.kind();
        if (own && value(knob.key) != nullptr && allows(knob)) {
            keys.emplace_back(knob.key);
        }
    }
    return keys;
}

std::vector<std::string> LossKeys::of(const std::string& cause) const {
    std::vector<std::string> keys;
    for (const LossKey& knob : kLossKeys) {
        const std::string accelerator = knob.accelerator;
        if (cause == knob.cause && (accelerator.empty() || accelerator == result_.config.kind()) &&
            can_move(knob) && is_movable(knob.key)) {
            const std::string linked = knob.linked;
            const std::string key = knob.key + (linked.empty() ? "" : " and " + linked);
            keys.push_back(knob.way == Way::Raise   ? "raise " + key
                           : knob.way == Way::Lower ? "lower " + key
                                                    : key + "=" + knob.limit);
        }
    }
    return keys;
}

} // namespace degs::sim
