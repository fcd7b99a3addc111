// SPDX-License-Identifier: Apache-2.0
// The keys of a design that move a loss of PE-cycles.
#pragma once

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
    std::vector<LossStep> movable() const;

    /// The one that moves most on close-ups first. A key is missing if the design does not have it,
    /// if it is at its limit or idle because of other keys or in this run, or if the design allows
    /// no step of it.
    std::vector<LossStep> of(const std::string& cause) const;
    /// The value of a key, if the design has it and it is a number above 0.
    std::optional<double> number(const std::string& key) const;

private:
    const nlohmann::ordered_json* value(const std::string& key) const;
    bool can_move(const LossKey& knob) const;
    bool is_idle(const std::string& key) const;
    /// The first change that the design allows; nothing if it allows none.
    std::optional<std::string> allowed_change(const LossKey& knob) const;
    bool allows(const std::string& change) const;

    const RunResult& result_;
    nlohmann::ordered_json config_;
    std::vector<LossKey> keys_;
};

} // namespace degs::sim
