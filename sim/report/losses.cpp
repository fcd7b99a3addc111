// SPDX-License-Identifier: Apache-2.0
#include "sim/report/losses.hpp"

#include <algorithm>

#include "base/ratio.hpp"
#include "sim/simulation/loss_keys.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

// A stage or the memory is the cause of waiting if it is busy for this share of the time.
constexpr double kBusy = 0.6;

/// The cause of a loss in words and by its name in LossKeys.
struct Cause {
    std::string words, name;
};

class Losses {
public:
    explicit Losses(const RunResult& result)
        : result_(result), run_(result.accelerator), keys_(result) {}

    std::vector<Loss> all() const {
        std::vector<Loss> losses;
        const double total = ratio_of(run_.cycles, 1) * run_.pes;
        const auto add = [&](const Cause& cause, double slots) {
            if (slots > 0) {
                losses.push_back({cause.words, slots / total, keys_.of(cause.name)});
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
        if (slot.slots != &SlotAccount::blocked) {
            return {slot.name, slot.name};
        }
        return memory_bound()       ? Cause{"blocked, for memory", "memory"}
               : packing_was_full() ? Cause{slot.name, "full"}
                                    : Cause{slot.name, slot.name};
    }

    bool packing_was_full() const {
        return std::any_of(run_.buffers.begin(), run_.buffers.end(), [](const BufferUse& buffer) {
            return buffer.name == "packing_buffer" && buffer.full_cycles > 0;
        });
    }

    /// What kept the first tasks of the run from coming earlier.
    Cause before(Cycle first) const {
        const std::string words = "before the first task";
        if (run_.array_only || first == 0) {
            return {words, "none"};
        }
        std::uint64_t bytes = 0;
        for (const StreamUse& stream : run_.streams) {
            bytes += stream.prepares ? stream.bytes_read + stream.bytes_written : 0;
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
        if (const auto rate = keys_.number("binning.pairs_per_cycle")) {
            consider("binning", ratio_of(result_.workload.tile_pairs, 1) / *rate / cycles);
        }
        return most;
    }

    /// The busiest of those that come before the array.
    Cause starvation() const {
        const StageUse* busiest = nullptr;
        for (const StageUse& stage : run_.stages) {
            if (!stage.array && (busiest == nullptr || stage.busy > busiest->busy)) {
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

    const RunResult& result_;
    const AcceleratorResult& run_;
    LossKeys keys_;
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
