// SPDX-License-Identifier: Apache-2.0
#include "sim/config/config_difference.hpp"

#include <algorithm>
#include <map>

#include "config/config_words.hpp"
#include "sim/text/text_table.hpp"

namespace degs::sim {
namespace {

std::string shown(const std::string& value) {
    return value.empty() ? "-" : value;
}

} // namespace

std::vector<KeyDifference> difference(const std::vector<KeyDoc>& first,
                                      const std::vector<KeyDoc>& second) {
    std::vector<KeyDifference> keys;
    std::map<std::string, std::size_t> places;
    for (const KeyDoc& key : first) {
        if (key.type != "section") {
            places[key.path] = keys.size();
            keys.push_back({key.path, key.default_value, ""});
        }
    }
    for (const KeyDoc& key : second) {
        const auto known = places.find(key.path);
        if (known != places.end()) {
            keys[known->second].second = key.default_value;
        } else if (key.type != "section") {
            keys.push_back({key.path, "", key.default_value});
        }
    }
    keys.erase(std::remove_if(keys.begin(), keys.end(),
                              [](const KeyDifference& key) { return key.first == key.second; }),
               keys.end());
    return keys;
}

std::string difference_text(const std::vector<KeyDifference>& keys, const std::string& first,
                            const std::string& second) {
    if (keys.empty()) {
        return "All keys have the same values.\n";
    }
    TextTable table({"key", first, second});
    for (const KeyDifference& key : keys) {
        table.add({key.path, shown(key.first), shown(key.second)});
    }
    return table.text();
}

std::string difference_markdown(const std::vector<KeyDifference>& keys, const std::string& first,
                                const std::string& second) {
    std::string table = "| Key | " + config_words::markdown_cell(first) + " | " +
                        config_words::markdown_cell(second) + " |\n|---|---|---|\n";
    for (const KeyDifference& key : keys) {
        table += "| `" + key.path + "` | " + config_words::markdown_cell(shown(key.first)) + " | " +
                 config_words::markdown_cell(shown(key.second)) + " |\n";
    }
    return table;
}

} // namespace degs::sim
