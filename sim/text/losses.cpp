// SPDX-License-Identifier: Apache-2.0
#include "sim/text/losses.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "config/config_document.hpp"
#include "config/ratio.hpp"
#include "modules/degs_config.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

enum class Way { Raise, Lower, Set };

/// A key moves a loss until it has come to `limit`: a number, or the value to set. Of several keys the
/// one that moves most on close-ups stands first.
struct Knob {
    const char* accelerator; ///< empty: all
    const char* cause;
    const char* key;
    Way way;
    const char* limit;
};

constexpr const char* kMost = "1e9"; // no limit but the key's range

constexpr Knob kKnobs[] = {
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
    {"degs", "gaps", "slicing.interleave", Way::Raise, "16"},
    {"degs", "gaps", "scheduler.queue_segments_per_pe", Way::Raise, "256"},
    {"degs", "gaps", "packing.bytes", Way::Raise, kMost},
    {"gscore", "gaps", "buffer.bytes", Way::Raise, kMost},
    {"gbu", "gaps", "engines.queue_depth", Way::Raise, "4096"},
    {"gbu", "gaps", "engines.row_pes", Way::Lower, "1"},
    {"gcc", "gaps", "group_buffer_bytes", Way::Raise, kMost},
    {"degs", "boundary", "pipeline.span_ends", Way::Set, "exact"},
    {"degs", "boundary", "span.parsing", Way::Set, "true"},
    {"gscore", "boundary", "array.subtile_skip", Way::Set, "exact"},
    {"gscore", "boundary", "array.lanes", Way::Lower, "16"},
    {"gbu", "boundary", "engines.end_probe", Way::Set, "false"},
    {"gcc", "boundary", "array.window", Way::Lower, "1"},
    {"degs", "terminated", "scheduler.termination", Way::Set, "pixel"},
    {"gscore", "terminated", "array.termination_cycles", Way::Lower, "1"},
    {"gbu", "terminated", "engines.termination_cycles", Way::Lower, "1"},
    {"gcc", "terminated", "array.skip_cycles", Way::Lower, "0"},
    {"degs", "conflict", "slicing.interleave", Way::Raise, "16"},
    {"degs", "conflict", "scheduler.queue_segments_per_pe", Way::Raise, "256"},
    {"degs", "conflict", "packing.bytes", Way::Raise, kMost},
    {"degs", "conflict", "scheduler.reuse_cycles", Way::Lower, "1"},
    {"degs", "conflict", "tile_size", Way::Raise, "1024"},
    {"gcc", "conflict", "array.discovery_cycles", Way::Lower, "1"},
    {"degs", "ports", "pixel_buffer.sram_banks", Way::Raise, kMost},
    {"degs", "ports", "packing.ports", Way::Set, "0"},
    {"degs", "blocked", "packing.bytes", Way::Raise, kMost},
    {"degs", "blocked", "packing.lead_packets", Way::Raise, "65536"},
    {"degs", "blocked", "pixel_buffer.bytes", Way::Raise, kMost},
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

// A stage or the memory is the cause of waiting if it is busy for this share of the time.
constexpr double kBusy = 0.6;

/// The cause of a loss in words and by its name in kKnobs.
struct Cause {
    std::string words, name;
};

class Losses {
public:
    explicit Losses(const RunResult& result)
        : result_(result), run_(result.accelerator), config_(resolved(RunConfig(result.config))) {}

    std::vector<Loss> all() const {
        std::vector<Loss> losses;
        const double total = ratio_of(run_.cycles, 1) * run_.pes;
        const auto add = [&](const Cause& cause, double slots) {
            if (slots > 0) {
                losses.push_back({cause.words, slots / total, keys_of(cause.name)});
            }
        };
        if (total <= 0) {
            return losses;
        }
        for (const SlotClass& slot : kSlotClasses) {
            if (slot.slots != &SlotAccount::useful) {
                add(cause_of(slot), ratio_of(run_.slots.*slot.slots, 1));
            }
        }
        const bool any = !run_.window.empty();
        const Cycle first = any ? run_.window.first : run_.cycles;
        const Cycle after =
            any && run_.cycles > run_.window.last ? run_.cycles - run_.window.last - 1 : 0;
        add(before(first), ratio_of(first, 1) * run_.pes);
        add({"after the last task", memory_bound() ? "memory" : "readout"},
            ratio_of(after, 1) * run_.pes);
        std::stable_sort(losses.begin(), losses.end(),
                         [](const Loss& a, const Loss& b) { return a.share > b.share; });
        return losses;
    }

private:
    bool limited_memory() const { return run_.memory_gb_per_s > 0; }
    bool memory_bound() const { return limited_memory() && run_.memory_utilization >= kBusy; }

    /// Tiles wait for their contexts while finished ones wait for the memory.
    Cause cause_of(const SlotClass& slot) const {
        if (slot.slots == &SlotAccount::starved) {
            return starvation();
        }
        const bool blocked = slot.slots == &SlotAccount::blocked;
        return blocked && memory_bound() ? Cause{"blocked, for memory", "memory"}
                                         : Cause{slot.name, slot.name};
    }

    /// What kept the first tasks of the run from coming earlier.
    Cause before(Cycle first) const {
        const std::string words = "before the first task";
        if (run_.array_only || first == 0) {
            return {words, "none"};
        }
        std::uint64_t bytes = 0;
        for (const StreamUse& stream : run_.streams) {
            for (const char* early : {"geometry", "sh", "means", "splats_written",
                                      "tile_lists_written", "group_lists_written"}) {
                bytes += stream.name == early ? stream.bytes_read + stream.bytes_written : 0;
            }
        }
        const double cycles = ratio_of(first, 1);
        const double frames = std::max(1.0, ratio_of(run_.frames.size(), 1));
        const double memory = limited_memory() ? rate_of(bytes, run_.memory_gb_per_s) *
                                                     run_.clock_ghz / frames / cycles
                                               : 0;
        if (memory >= kBusy) {
            return {words + ", for memory", "memory"};
        }
        Cause most{words, "latency"};
        double share = 0.3; // less is latency
        const auto consider = [&](const char* name, double part) {
            if (part > share) {
                share = part;
                most = {words + ", for " + name, name};
            }
        };
        for (const StageUse& stage : run_.stages) {
            if (stage.name == "projection" || stage.name == "grouping") {
                consider(stage.name.c_str(), stage.busy_cycles / stage.units / frames / cycles);
            }
        }
        if (const auto rate = number("binning.pairs_per_cycle")) {
            consider("binning", ratio_of(result_.workload.tile_pairs, 1) / *rate / cycles);
        }
        return most;
    }

    /// The busiest of those that come before the array.
    Cause starvation() const {
        const StageUse* busiest = nullptr;
        for (const StageUse& stage : run_.stages) {
            const bool array = stage.name == "blending" || stage.name == "row_pes";
            if (!array && (busiest == nullptr || stage.busy > busiest->busy)) {
                busiest = &stage;
            }
        }
        const double stage = busiest == nullptr ? 0 : busiest->busy;
        if (memory_bound() && run_.memory_utilization >= stage) {
            return {"starved, for memory", "memory"};
        }
        if (stage >= kBusy) {
            return {"starved, for " + busiest->name, busiest->name};
        }
        return {"starved", "gaps"};
    }

    /// The value of a key, if the design has it.
    const nlohmann::ordered_json* value(const std::string& key) const {
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
    std::optional<double> number(const std::string& key) const {
        const nlohmann::ordered_json* found = value(key);
        return found != nullptr && found->is_number() && found->get<double>() > 0
                   ? std::optional<double>(found->get<double>())
                   : std::nullopt;
    }

    bool can_move(const Knob& knob) const {
        const std::string key = knob.key;
        const nlohmann::ordered_json* const now = value(key);
        const bool lpddr5 = value("memory.model") != nullptr && *value("memory.model") == "lpddr5";
        if (now == nullptr || (key.rfind("memory.lpddr5", 0) == 0 && !lpddr5) ||
            (lpddr5 && (key == "memory.bandwidth_gb_per_s" || key == "memory.latency_ns"))) {
            return false;
        }
        if (run_.array_only && key.rfind("memory.", 0) == 0) {
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

    /// Keys that other keys of DeGS make idle. The Packing Buffer holds the waiting segments, as many
    /// as it has room for if queue_segments_per_pe is 0, and the packets, up to lead_packets.
    bool can_move_in_degs(const std::string& key, const std::string& cause) const {
        const auto& config = dynamic_cast<const DegsConfig&>(result_.config.accelerator());
        const bool fill_buffer = config.scheduler.queue_segments_per_pe == 0;
        const bool few_packets = config.packing_depth() < config.packing.lead_packets;
        if (key == "packing.bytes") {
            return fill_buffer || (cause == "blocked" && few_packets);
        }
        if (key == "packing.lead_packets") {
            return !few_packets;
        }
        if (key == "scheduler.queue_segments_per_pe") {
            return !fill_buffer;
        }
        return key != "span.rows_per_cycle" || config.spans_are_pooled();
    }

    std::vector<std::string> keys_of(const std::string& cause) const {
        std::vector<std::string> keys;
        for (const Knob& knob : kKnobs) {
            const std::string accelerator = knob.accelerator;
            if (cause == knob.cause &&
                (accelerator.empty() || accelerator == result_.config.kind()) && can_move(knob)) {
                const std::string key = knob.key;
                keys.push_back(knob.way == Way::Raise   ? "raise " + key
                               : knob.way == Way::Lower ? "lower " + key
                                                        : key + "=" + knob.limit);
            }
        }
        return keys;
    }

    const RunResult& result_;
    const AcceleratorResult& run_;
    nlohmann::ordered_json config_;
};

/// "raise a, raise b or c=d"
std::string choice_of(const std::vector<std::string>& keys) {
    std::string words;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        words += (i == 0 ? "" : i + 1 == keys.size() ? " or " : ", ") + keys[i];
    }
    return words;
}

} // namespace

std::vector<Loss> losses_of(const RunResult& result) {
    return Losses(result).all();
}

std::string losses_line(const RunResult& result) {
    std::vector<Loss> losses = losses_of(result);
    losses.resize(std::min<std::size_t>(losses.size(), 3));
    std::string line;
    for (const Loss& loss : losses) {
        line += (line.empty() ? "" : " · ") + loss.reason + " " + percent(loss.share) +
                (line.empty() ? " % of the frame" : " %") +
                (loss.keys.empty() ? "" : " (" + choice_of(loss.keys) + ")");
    }
    return line.empty() ? "none" : line;
}

} // namespace degs::sim
