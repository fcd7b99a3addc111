// SPDX-License-Identifier: Apache-2.0
#include "sim/config/shared_keys.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "config/config_words.hpp"
#include "sim/design/run_config.hpp"

namespace degs::sim {
namespace {

/// What makes two keys the same: path, type, range and meaning.
using Meaning = std::tuple<std::string, std::string, std::string, std::string>;

/// All accelerators' keys in the order of the first that has them, with the defaults by
/// accelerator.
struct Common {
    KeyDoc key;
    std::map<std::string, std::string> defaults;
};

Meaning meaning_of(const KeyDoc& key) {
    return {key.path, key.type, key.allowed, key.doc};
}

const std::vector<Common>& all_keys() {
    static const std::vector<Common> keys = [] {
        std::vector<Common> found;
        std::map<Meaning, std::size_t> places;
        for (const std::string& name : accelerator_names()) {
            for (const KeyDoc& key : document(default_run_config(name, {}))) {
                const auto place = places.emplace(meaning_of(key), found.size()).first;
                if (place->second == found.size()) {
                    found.push_back({key, {}});
                }
                found[place->second].defaults[name] = key.default_value;
            }
        }
        return found;
    }();
    return keys;
}

/// Whether the key is a block of Table I or a value of it: cost.degs.span_engine.area_mm2.
bool is_cost_row(const KeyDoc& key) {
    const std::size_t dots = std::count(key.path.begin(), key.path.end(), '.');
    return key.path.rfind("cost.", 0) == 0 && (dots > 2 || (dots == 2 && key.type == "section"));
}

/// "shared" if all accelerators have the key with one default, "similar" if several have it, "cost"
/// in the rows of one accelerator's areas and powers, else "own".
std::string part_of(const Common& common) {
    std::set<std::string> values;
    for (const auto& [name, value] : common.defaults) {
        values.insert(value);
    }
    const bool all = common.defaults.size() == accelerator_names().size();
    return all && values.size() == 1    ? "shared"
           : common.defaults.size() > 1 ? "similar"
           : is_cost_row(common.key)    ? "cost"
                                        : "own";
}

} // namespace

const std::vector<std::string>& key_parts() {
    static const std::vector<std::string> parts{"all", "shared", "similar", "own", "cost"};
    return parts;
}

std::vector<KeyDoc> keys_of_part(const std::vector<KeyDoc>& document, const std::string& part) {
    if (part == "all") {
        return document;
    }
    std::map<Meaning, std::string> parts;
    for (const Common& common : all_keys()) {
        parts[meaning_of(common.key)] = part_of(common);
    }
    std::vector<KeyDoc> keys;
    for (const KeyDoc& key : document) {
        if (parts.at(meaning_of(key)) == part) {
            keys.push_back(key);
        }
    }
    return keys;
}

std::string similar_keys_markdown() {
    std::string header = "| Key |", rule = "|---|";
    for (const std::string& name : accelerator_names()) {
        header += " " + name + " |";
        rule += "---|";
    }
    std::string table = header + " Allowed | Meaning |\n" + rule + "---|---|\n";
    for (const Common& common : all_keys()) {
        if (part_of(common) != "similar" || common.key.type == "section") {
            continue;
        }
        table += "| `" + common.key.path + "` |";
        for (const std::string& name : accelerator_names()) {
            const auto value = common.defaults.find(name);
            table += value == common.defaults.end() ? " |" : " `" + value->second + "` |";
        }
        table += " " + markdown_allowed(common.key) + " | " +
                 config_words::markdown_cell(common.key.doc) + " |\n";
    }
    return table;
}

std::string cost_keys_markdown() {
    const std::vector<std::string> columns{"area_mm2",        "power_w", "units",     "bytes",
                                           "bytes_per_cycle", "ports",   "sram_banks"};
    std::string table = "| Section |", rule = "|---|";
    for (const std::string& column : columns) {
        table += " " + column + " |";
        rule += "---:|";
    }
    table += " Meaning |\n" + rule + "---|\n";
    std::map<std::string, std::string> values;
    for (const Common& common : all_keys()) {
        if (part_of(common) == "cost" && common.key.type != "section") {
            values[common.key.path] = common.defaults.begin()->second;
        }
    }
    for (const Common& common : all_keys()) {
        if (part_of(common) == "cost" && common.key.type == "section") {
            table += "| `" + common.key.path + "` |";
            for (const std::string& column : columns) {
                const auto value = values.find(common.key.path + "." + column);
                table += value == values.end() ? " |" : " " + value->second + " |";
            }
            table += " " + config_words::markdown_cell(common.key.doc) + " |\n";
        }
    }
    return table;
}

} // namespace degs::sim
