// SPDX-License-Identifier: Apache-2.0
#include "sim/report/losses.hpp"

#include <algorithm>

#include "base/ratio.hpp"
#include "modules/kit/accelerator/waiting_causes.hpp"
#include "sim/simulation/loss_keys.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/text/words.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

// Beside the longest part of the time before the first task, another one that is shorter by less
// than this is its cause, too: to shorten only one of the two leaves the other.
constexpr double kAlike = 0.1;
// The latency of memory is a cause if units waited for answers for this part of the time that is
// lost.
constexpr double kLate = 0.5;

/// The cause of a loss in words and by its name in LossKeys.
struct Cause {
    std::string words, name;
};

class Losses {
public:
    explicit Losses(const RunResult& result)
        : result_(result), run_(result.accelerator), causes_(run_), keys_(result) {}

    std::vector<Loss> all() const {
        std::vector<Loss> losses;
        const double total = real_of(run_.cycles) * run_.pes;
        const auto add = [&](const Cause& cause, double slots) {
            if (slots > 0) {
                losses.push_back({cause.words, slots / total, keys_.of(cause.name)});
            }
        };
        if (total <= 0) {
            return losses;
        }
        for (const SlotClass& slot : kSlotClasses) {
            if (slot.slot != Slot::Useful) {
                add(cause_of(slot), real_of(run_.slots[slot.slot]));
            }
        }
        const bool any = !run_.window.empty();
        const Cycle first = causes_.before_first();
        const Cycle after =
            any && run_.cycles > run_.window.last ? run_.cycles - run_.window.last - 1 : 0;
        add(before(first), real_of(first) * run_.pes);
        add({"after the last task", after_cause(real_of(after))}, real_of(after) * run_.pes);
        std::stable_sort(losses.begin(), losses.end(),
                         [](const Loss& a, const Loss& b) { return a.share > b.share; });
        return losses;
    }

private:
    double frames() const { return std::max(1.0, real_of(run_.frames.size())); }

    /// The last pixels are read out, and then on their way to the memory. Only a memory whose
    /// latency is a key names one for it; LPDDR5 leaves memory.latency_ns without effect.
    std::string after_cause(double cycles) const {
        const double latency = keys_.number("memory.latency_ns").value_or(0) * run_.clock_ghz;
        const bool is_latency = latency > cycles / 2 && !keys_.of("latency").empty();
        return causes_.is_memory_busy()            ? "memory"
               : is_latency                        ? "latency"
               : is_written_slower_than_read_out() ? "memory"
                                                   : "readout";
    }

    /// Whether the memory takes longer for the pixels of a tile than the buffer that reads them
    /// out.
    bool is_written_slower_than_read_out() const {
        const double pixels = real_of(drawn_pixels(result_)) * frames(); // of all views
        const auto written =
            std::find_if(run_.streams.begin(), run_.streams.end(),
                         [](const StreamUse& s) { return s.name == "frame_buffer"; });
        if (!causes_.has_limited_memory() || pixels == 0 || written == run_.streams.end()) {
            return false;
        }
        const double bytes = real_of(written->bytes_written) / pixels;
        return run_.readout_pixels * bytes > run_.memory_gb_per_s / run_.clock_ghz;
    }

    /// Tiles wait for their contexts while finished ones wait for the memory.
    Cause cause_of(const SlotClass& slot) const {
        if (slot.slot == Slot::Starved) {
            return starvation();
        }
        if (slot.slot != Slot::Blocked) {
            return {slot.name, slot.name};
        }
        return causes_.is_memory_busy() ? Cause{"blocked, for memory", "memory"}
               : is_late(run_.waits.pixels, run_.slots[Slot::Blocked])
                   ? Cause{"blocked, for the latency of memory", "acknowledgements"}
                   : Cause{slot.name, slot.name};
    }

    bool is_late(double waits, std::uint64_t slots) const {
        return waits >= kLate * ratio_of(slots, run_.pes);
    }

    /// What kept the first tasks of the run from coming earlier. Memory and stages prepare a frame
    /// at the same time, so it is the one that took longest; of two that took equally long, both,
    /// in the order of WaitingCauses::preparation().
    Cause before(Cycle first) const {
        const std::string words = "before the first task";
        if (run_.array_only || first == 0) {
            return {words, "none"};
        }
        const std::vector<WaitingCauses::Part> parts = causes_.preparation();
        double longest = 0;
        for (const WaitingCauses::Part& part : parts) {
            longest = std::max(longest, part.share);
        }
        if (longest < WaitingCauses::kLong) {
            return {words, "latency"};
        }
        std::string name;
        for (const WaitingCauses::Part& part : parts) {
            if (part.share > longest - kAlike) {
                name += (name.empty() ? "" : " and ") + part.name;
            }
        }
        return {words + ", for " + name, name};
    }

    /// The busiest of those that come before the array, while it worked.
    Cause starvation() const {
        const std::string busiest = causes_.starved_for();
        if (!busiest.empty()) {
            return {"starved, for " + busiest, busiest};
        }
        const std::string words = "starved, for the latency of memory";
        // An array whose units wait for contexts may not tell blocked from starved.
        return is_late(run_.waits.splats, run_.slots[Slot::Starved]) ? Cause{words, "answers"}
               : run_.slots[Slot::Blocked] == 0 &&
                       is_late(run_.waits.pixels, run_.slots[Slot::Starved])
                   ? Cause{words, "acknowledgements"}
                   : Cause{"starved", "gaps"};
    }

    const RunResult& result_;
    const AcceleratorResult& run_;
    WaitingCauses causes_;
    LossKeys keys_;
};

constexpr std::size_t kNamed = 3; // losses of which a person reads

/// The change that gains most, or "raise a, raise b or c=d" where none was estimated.
std::string advice_of(const Loss& loss, const RunResult& result) {
    if (const WhatIf* const best = best_gain(loss, result)) {
        constexpr double kShown = 0.0005; // less is 0.0 %
        const double gain = -best->share();
        return best->change + (gain < kShown ? " gains nothing" : " gains " + percent(gain) + " %");
    }
    std::string words;
    for (std::size_t i = 0; i < loss.keys.size(); ++i) {
        words += (i == 0 ? "" : i + 1 == loss.keys.size() ? " or " : ", ") + loss.keys[i].words;
    }
    return words.empty() ? "no key is known to move it" : words;
}

} // namespace

std::vector<Loss> losses_of(const RunResult& result) {
    return Losses(result).all();
}

std::vector<Loss> largest_losses(const RunResult& result) {
    std::vector<Loss> losses = losses_of(result);
    losses.resize(std::min(losses.size(), kNamed));
    return losses;
}

std::vector<std::string> named_changes(const RunResult& result) {
    std::vector<std::string> changes;
    for (const Loss& loss : largest_losses(result)) {
        for (const LossStep& key : loss.keys) {
            if (std::find(changes.begin(), changes.end(), key.change) == changes.end()) {
                changes.push_back(key.change);
            }
        }
    }
    return changes;
}

const WhatIf* best_gain(const Loss& loss, const RunResult& result) {
    const WhatIf* best = nullptr;
    for (const LossStep& key : loss.keys) {
        for (const WhatIf& gain : result.gains) {
            if (gain.change == key.change && (best == nullptr || gain.share() < best->share())) {
                best = &gain;
            }
        }
    }
    return best;
}

std::string losses_line(const RunResult& result) {
    std::string line;
    for (const Loss& loss : largest_losses(result)) {
        line += (line.empty() ? "" : " · ") + loss.reason + " " + percent(loss.share) +
                (line.empty() ? " % of the frame" : " %") + " (" + advice_of(loss, result) + ")";
    }
    return line.empty() ? "none" : line;
}

} // namespace degs::sim
