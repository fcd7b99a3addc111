// SPDX-License-Identifier: Apache-2.0
// Keys that are named for a loss, without a run.
#include "sim/simulation/loss_keys.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "degs/error.hpp"

namespace degs::sim {
namespace {

/// Whether a key that any step may move is named where it has this value; empty if it cannot have.
std::optional<bool> is_named(const LossKey& knob, const std::string& value) {
    RunResult result;
    try {
        result.config = default_run_config("degs", {std::string(knob.key) + "=" + value});
    } catch (const InputError&) {
        return {};
    }
    result.movable_keys = {knob.name()};
    const std::string words = (knob.way == LossKey::Way::Raise ? "raise " : "lower ") + knob.name();
    const std::vector<std::string> keys = LossKeys(result).of(knob.cause);
    return std::find(keys.begin(), keys.end(), words) != keys.end();
}

TEST(LossKeys, AreNotNamedAtTheirLimits) {
    int at_limits = 0, before = 0;
    for (const LossKey& knob : default_run_config("degs", {}).accelerator().loss_keys()) {
        if (knob.way != LossKey::Way::Set) {
            const int limit = std::stoi(knob.limit);
            const int other = knob.way == LossKey::Way::Raise ? limit / 2 : limit * 2;
            at_limits += is_named(knob, knob.limit).has_value() ? 1 : 0;
            EXPECT_FALSE(is_named(knob, knob.limit).value_or(false)) << knob.key;
            before += is_named(knob, std::to_string(other)).value_or(false) ? 1 : 0;
        }
    }
    EXPECT_GE(at_limits, 3);
    EXPECT_GE(before, 3);
}

} // namespace
} // namespace degs::sim
