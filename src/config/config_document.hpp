// SPDX-License-Identifier: Apache-2.0
// Writes a configuration into results, into a file that reproduces it, or into the manual.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "config/config.hpp"

namespace degs {

/// One row of the manual; sections have rows too (type "section", no default).
struct KeyDoc {
    std::string path;          ///< hierarchical name, e.g. "memory.latency_ns"
    std::string type;          ///< section, integer, real, boolean, text or choice
    std::string default_value; ///< as it is written in YAML
    std::string allowed;       ///< range, list of choices, or what a text must be
    std::string doc;
    std::string spelling = ""; ///< of a text, as an extended regular expression; empty: any
};

using Describe = std::function<void(ConfigVisitor&)>;
nlohmann::ordered_json resolved_json(const Describe& describe);
std::string resolved_yaml_text(const Describe& describe);
std::vector<KeyDoc> document_keys(const Describe& describe);

/// Returns every value, nested as in YAML, with choices by name. Every report contains it.
template <class Config>
nlohmann::ordered_json resolved(Config config) {
    return resolved_json([&](ConfigVisitor& visitor) { config.describe(visitor); });
}

/// Returns the same as a YAML file with the meaning behind each key; loading it gives the same
/// struct.
template <class Config>
std::string resolved_yaml(Config config) {
    return resolved_yaml_text([&](ConfigVisitor& visitor) { config.describe(visitor); });
}

/// Lists the keys that a user may write, in the order of `describe`; the defaults are the values of
/// `config`.
template <class Config>
std::vector<KeyDoc> document(Config config) {
    return document_keys([&](ConfigVisitor& visitor) { config.describe(visitor); });
}

/// The cell "allowed" of a Markdown table: 1..64 of integers, "real 0..10", "text", or the choices
/// or spelling.
std::string markdown_allowed(const KeyDoc& key);

/// Returns a Markdown table with the columns key, default, allowed and meaning; sections have no
/// row.
std::string markdown_table(const std::vector<KeyDoc>& keys);

} // namespace degs
