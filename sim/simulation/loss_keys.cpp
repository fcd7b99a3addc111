// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/loss_keys.hpp"

#include <algorithm>
#include <cmath>

#include "config/config_document.hpp"
#include "config/config_source.hpp"
#include "degs/error.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {

using Way = LossKey::Way;

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

// Whether the design allows some step, a factor or its square for a linked key. A key at the end of
// its range has none: what leads beyond is refused.
bool LossKeys::allows(const LossKey& knob) const {
    const std::string key = knob.key, linked = knob.linked;
    if (knob.way == Way::Set) {
        return allows({key + "=" + knob.value});
    }
    const auto stepped = [&](const std::string& name, double factor) {
        const double now = value(name)->get<double>();
        return knob.way == Way::Raise ? std::max(now, 1.0) * factor : std::floor(now / factor);
    };
    const auto setting = [&](const std::string& name, double factor) {
        return name + "=" + decimal_text(stepped(name, factor));
    };
    for (const double factor : {2.0, 4.0, 8.0, 16.0}) {
        if (stepped(key, factor) == value(key)->get<double>()) {
            return false; // 0 cannot be lowered
        }
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

std::vector<std::string> LossKeys::movable() const {
    std::vector<std::string> keys;
    for (const LossKey& knob : keys_) {
        if (value(knob.key) != nullptr && (*knob.linked == 0 || value(knob.linked) != nullptr) &&
            allows(knob)) {
            keys.push_back(knob.name());
        }
    }
    return keys;
}

std::vector<std::string> LossKeys::of(const std::string& cause) const {
    std::vector<std::string> keys;
    for (const LossKey& knob : keys_) {
        const std::string key = knob.name();
        if (cause == knob.cause && can_move(knob) && is_movable(key) && !is_idle(key)) {
            keys.push_back(knob.way == Way::Raise   ? "raise " + key
                           : knob.way == Way::Lower ? "lower " + key
                                                    : key + "=" + knob.value);
        }
    }
    return keys;
}

} // namespace degs::sim
