// SPDX-License-Identifier: Apache-2.0
#include "sim/config/shared_keys.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

#include "sim/simulation/run_config.hpp"

namespace degs::sim {
namespace {

using Row = std::tuple<std::string, std::string, std::string, std::string, std::string>;

std::set<Row> default_rows(const std::string& accelerator) {
    std::set<Row> rows;
    for (const KeyDoc& key : document(default_run_config(accelerator, {}))) {
        rows.emplace(key.path, key.type, key.default_value, key.allowed, key.doc);
    }
    return rows;
}

std::set<std::string> shared_paths() {
    const std::vector<std::string> names = accelerator_names();
    std::set<Row> shared = default_rows(names.front());
    for (const std::string& name : names) {
        const std::set<Row> rows = default_rows(name);
        std::set<Row> common;
        std::set_intersection(shared.begin(), shared.end(), rows.begin(), rows.end(),
                              std::inserter(common, common.end()));
        shared = std::move(common);
    }
    std::set<std::string> paths;
    for (const Row& row : shared) {
        paths.insert(std::get<0>(row));
    }
    return paths;
}

} // namespace

const std::vector<std::string>& key_parts() {
    static const std::vector<std::string> parts{"all", "shared", "own"};
    return parts;
}

std::vector<KeyDoc> keys_of_part(const std::vector<KeyDoc>& document, const std::string& part) {
    if (part == "all") {
        return document;
    }
    const std::set<std::string> shared = shared_paths();
    std::vector<KeyDoc> keys;
    for (const KeyDoc& key : document) {
        if ((shared.count(key.path) != 0) == (part == "shared")) {
            keys.push_back(key);
        }
    }
    return keys;
}

} // namespace degs::sim
