// SPDX-License-Identifier: Apache-2.0
// The keys of a design that move a loss of PE-cycles.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "modules/kit/accelerator/loss_keys.hpp"
#include "sim/simulation/run_result.hpp"

namespace degs::sim {

/// Which of the keys that an accelerator names for its losses its design can still move.
class LossKeys {
public:
    explicit LossKeys(const RunResult& result);

    /// Keys of which the design allows a step, for RunResult::movable_keys; needs its configuration
    /// alone.
    std::vector<std::string> movable() const;

    /// "raise KEY", "lower KEY and KEY" or "KEY=VALUE", the one that moves most on close-ups first.
    /// A key is missing if the design does not have it, if it is at its limit or idle because of
    /// other keys or in this run, or if the design allows no step of it.
    std::vector<std::string> of(const std::string& cause) const;
    /// The value of a key, if the design has it and it is a number above 0.
    std::optional<double> number(const std::string& key) const;

private:
    const nlohmann::ordered_json* value(const std::string& key) const;
    bool can_move(const LossKey& knob) const;
    static bool has(const std::vector<std::string>& keys, const std::string& key) {
        return std::find(keys.begin(), keys.end(), key) != keys.end();
    }
    bool is_movable(const std::string& key) const { return has(result_.movable_keys, key); }
    bool is_idle(const std::string& key) const { return has(result_.accelerator.idle_keys, key); }
    bool allows(const LossKey& knob) const;
    bool allows(const std::vector<std::string>& settings) const;

    const RunResult& result_;
    nlohmann::ordered_json config_;
    std::vector<LossKey> keys_;
};

} // namespace degs::sim
