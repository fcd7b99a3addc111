// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "config/config_document.hpp"
#include "sim/compare/comparison_output.hpp"
#include "sim/page/page.hpp"

namespace degs::sim {
namespace {

/// Values by key; a text without its quotes.
std::map<std::string, std::string> values_of(const std::vector<KeyDoc>& keys) {
    std::map<std::string, std::string> values;
    for (const KeyDoc& key : keys) {
        values[key.path] = key.type == "text" ? parse_json(key.default_value).get<std::string>()
                                              : key.default_value;
    }
    return values;
}

/// Whether those of the configurations that have the key disagree about it.
bool differs(const std::vector<std::map<std::string, std::string>>& configs,
             const std::string& key) {
    const std::string* first = nullptr;
    for (const auto& values : configs) {
        const auto value = values.find(key);
        if (value != values.end() && first != nullptr && *first != value->second) {
            return true;
        }
        first = first == nullptr && value != values.end() ? &value->second : first;
    }
    return false;
}

} // namespace

std::string comparison_page(const std::vector<NamedConfig>& configs, const Comparison& comparison) {
    PageFacts facts;
    facts.title = "Comparison of " + std::to_string(configs.size()) +
                  (configs.size() == 1 ? " design" : " designs");
    std::vector<std::map<std::string, std::string>> values;
    for (const NamedConfig& config : configs) {
        const std::vector<KeyDoc> keys = document(config.config);
        values.push_back(values_of(keys));
        for (const KeyDoc& key : keys) {
            const auto known = std::find(facts.keys.begin(), facts.keys.end(), key.path);
            if (key.type != "section" && key.path != "name" && known == facts.keys.end()) {
                facts.keys.push_back(key.path);
            }
        }
    }
    facts.keys.erase(
        std::remove_if(facts.keys.begin(), facts.keys.end(),
                       [&values](const std::string& key) { return !differs(values, key); }),
        facts.keys.end());
    for (std::size_t c = 0; c < configs.size(); ++c) {
        PageFacts::Variant variant{configs[c].name, {}};
        for (const std::string& key : facts.keys) {
            const auto value = values[c].find(key);
            variant.values.push_back(value == values[c].end() ? std::nullopt
                                                              : std::optional(value->second));
        }
        facts.variants.push_back(std::move(variant));
    }
    for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
        facts.points.push_back(r + 1);
    }
    for (const FailedRun& failed : comparison.failed) {
        facts.failed.emplace_back(failed.config.empty() ? failed.view
                                                        : failed.config + ", " + failed.view,
                                  failed.sentence);
    }
    return study_page(facts, comparison);
}

} // namespace degs::sim
