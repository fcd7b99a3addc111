// SPDX-License-Identifier: Apache-2.0
// Keys that are named for a loss, without a run.
#include "sim/simulation/loss_keys.hpp"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "config/config_document.hpp"
#include "degs/error.hpp"

namespace degs::sim {
namespace {

/// Whether a key is named where it has this value; empty if it cannot have.
std::optional<bool> is_named(const LossKey& knob, const std::string& value) {
    RunResult result;
    try {
        result.config = default_run_config("degs", {std::string(knob.key) + "=" + value});
    } catch (const InputError&) {
        return {};
    }
    result.movable_keys = LossKeys(result).movable();
    const std::string words = (knob.way == LossKey::Way::Raise ? "raise " : "lower ") + knob.name();
    const std::vector<LossStep> steps = LossKeys(result).of(knob.cause);
    return std::any_of(steps.begin(), steps.end(),
                       [&words](const LossStep& step) { return step.words == words; });
}

/// The end of a range, "1 to 64" or "at least 0", that a way leads to; empty if it has none.
std::string end_of(const std::string& range, LossKey::Way way) {
    const std::size_t to = range.find(" to ");
    const std::string least = "at least ";
    if (way == LossKey::Way::Raise) {
        return to == std::string::npos ? "" : range.substr(to + 4);
    }
    return range.rfind(least, 0) == 0 ? range.substr(least.size()) : range.substr(0, to);
}

TEST(LossKeys, AreNotNamedAtTheEndsOfTheirRanges) {
    int ends = 0, before = 0;
    const RunConfig config = default_run_config("degs", {});
    std::map<std::string, std::string> ranges;
    for (const KeyDoc& key : document(config)) {
        ranges[key.path] = key.allowed;
    }
    for (const LossKey& knob : config.accelerator().loss_keys()) {
        if (knob.way == LossKey::Way::Set || end_of(ranges.at(knob.key), knob.way).empty()) {
            continue;
        }
        const std::string end = end_of(ranges.at(knob.key), knob.way);
        const std::optional<bool> at_end = is_named(knob, end);
        ends += at_end.has_value() ? 1 : 0;
        EXPECT_FALSE(at_end.value_or(false)) << knob.key << "=" << end;
        const double other = knob.way == LossKey::Way::Raise ? std::stod(end) / 2
                                                             : std::max(std::stod(end), 1.0) * 2;
        before += is_named(knob, std::to_string(static_cast<int>(other))).value_or(false) ? 1 : 0;
    }
    EXPECT_GE(ends, 3);
    EXPECT_GE(before, 3);
    EXPECT_FALSE(is_named({"latency", "memory.latency_ns", LossKey::Way::Lower}, "0").value());
}

} // namespace
} // namespace degs::sim
