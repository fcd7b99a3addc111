// SPDX-License-Identifier: Apache-2.0
#include "modules/formats_config.hpp"

#include "splat/numbers/number_override.hpp"

namespace degs {
namespace {

constexpr const char* kUnchanged = "set";

struct Place {
    std::string section, key;
};

/// "exp.entries" is the key `entries` of the section `exp`.
Place place_of(const std::string& name) {
    const std::size_t dot = name.find('.');
    return dot == std::string::npos ? Place{"", name}
                                    : Place{name.substr(0, dot), name.substr(dot + 1)};
}

} // namespace

FormatsConfig::FormatsConfig() : values_(number_keys().size(), kUnchanged) {}

void FormatsConfig::describe(ConfigVisitor& visitor) {
    std::string open;
    const auto enter = [&](const std::string& section) {
        if (section != open && !open.empty()) {
            visitor.end_section();
        }
        if (section != open && !section.empty()) {
            visitor.begin_section(section.c_str(), section == "sqrt" ? "table of sqrt(1 - x)"
                                                                     : "table of the exponential");
        }
        open = section;
    };
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const NumberKey& key = number_keys()[i];
        const Place place = place_of(key.name);
        enter(place.section);
        visitor.text(place.key.c_str(), values_[i], key.meaning.c_str());
        NumberSet probe;
        const std::string rule =
            values_[i] == kUnchanged ? "" : override_number(probe, key.name, values_[i]);
        visitor.require(rule.empty(), {place.key.c_str(), rule, ""});
    }
    enter("");
}

std::vector<std::string> FormatsConfig::assignments() const {
    std::vector<std::string> changes;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if (values_[i] != kUnchanged) {
            changes.push_back(number_keys()[i].name + "=" + values_[i]);
        }
    }
    return changes;
}

} // namespace degs
