// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/loss_keys.hpp"

#include <algorithm>
#include <cmath>

#include "config/config_document.hpp"
#include "config/config_source.hpp"
#include "degs/error.hpp"
#include "sim/text/comma_parts.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {

using Way = LossKey::Way;

namespace {

std::string words_of(const LossKey& knob) {
    return knob.way == Way::Raise   ? "raise " + knob.name()
           : knob.way == Way::Lower ? "lower " + knob.name()
                                    : knob.name() + "=" + knob.value;
}

} // namespace

LossKeys::LossKeys(const RunResult& result)
    : result_(result), config_(resolved(RunConfig(result.config))),
      keys_(result.config.accelerator().loss_keys()) {}

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
    if (now == nullptr || (*knob.linked != 0 && value(knob.linked) == nullptr)) {
        return false;
    }
    if (result_.accelerator.array_only && key.rfind("memory.", 0) == 0) {
        return false;
    }
    const std::string text = now->is_string() ? now->get<std::string>() : now->dump();
    return knob.way != Way::Set || text != knob.value;
}

bool LossKeys::is_idle(const std::string& key) const {
    const std::vector<std::string>& idle = result_.accelerator.idle_keys;
    return std::find(idle.begin(), idle.end(), key) != idle.end();
}

// A factor, or its square for a linked key. A key at the end of its range has no step: what leads
// beyond is refused.
std::optional<std::string> LossKeys::allowed_change(const LossKey& knob) const {
    const std::string key = knob.key, linked = knob.linked;
    const auto stepped = [&](const std::string& name, double factor) {
        const double now = value(name)->get<double>();
        return knob.way == Way::Raise ? std::max(now, 1.0) * factor : std::floor(now / factor);
    };
    const auto setting = [&](const std::string& name, double factor) {
        return name + "=" + decimal_text(stepped(name, factor));
    };
    std::vector<std::string> changes;
    if (knob.way == Way::Set) {
        changes.push_back(key + "=" + knob.value);
    } else {
        for (const double factor : {2.0, 4.0, 8.0, 16.0}) {
            if (stepped(key, factor) == value(key)->get<double>()) {
                break; // 0 cannot be lowered
            }
            const std::string first = setting(key, factor);
            if (linked.empty()) {
                changes.push_back(first);
            } else {
                changes.push_back(first + "," + setting(linked, factor));
                changes.push_back(first + "," + setting(linked, factor * factor));
            }
        }
    }
    const auto found = std::find_if(changes.begin(), changes.end(),
                                    [this](const std::string& change) { return allows(change); });
    return found == changes.end() ? std::nullopt : std::optional<std::string>(*found);
}

bool LossKeys::allows(const std::string& change) const {
    RunConfig changed = result_.config;
    try {
        ConfigSource::from_overrides(comma_parts(change)).load(changed);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

std::vector<LossStep> LossKeys::movable() const {
    std::vector<LossStep> steps;
    for (const LossKey& knob : keys_) {
        if (value(knob.key) == nullptr || (*knob.linked != 0 && value(knob.linked) == nullptr)) {
            continue;
        }
        if (const std::optional<std::string> change = allowed_change(knob)) {
            steps.push_back({words_of(knob), *change});
        }
    }
    return steps;
}

std::vector<LossStep> LossKeys::of(const std::string& cause) const {
    std::vector<LossStep> steps;
    for (const LossKey& knob : keys_) {
        if (cause != knob.cause || !can_move(knob) || is_idle(knob.name())) {
            continue;
        }
        const auto step = std::find_if(
            result_.movable_keys.begin(), result_.movable_keys.end(),
            [words = words_of(knob)](const LossStep& known) { return known.words == words; });
        if (step != result_.movable_keys.end()) {
            steps.push_back(*step);
        }
    }
    return steps;
}

} // namespace degs::sim
