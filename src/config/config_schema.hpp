// SPDX-License-Identifier: Apache-2.0
// The JSON Schema (draft 2020-12) of what describes itself to a ConfigVisitor, for editors and for
// programs that write configurations.
#pragma once

#include "config/config_document.hpp"

namespace degs {

/// The schema of the section that `describe` visits: type, range, words, meaning and default of
/// every key, and no key else. Each section may begin with `include`, which is the definition
/// include_schema(), and its place in a document is "#/$defs/include".
nlohmann::ordered_json schema_json(const Describe& describe);
nlohmann::ordered_json include_schema();
/// The schema that is a definition of the document.
nlohmann::ordered_json schema_reference(const std::string& definition);

/// Describes the keys of a struct; the defaults are the values of `config`.
template <class Config>
nlohmann::ordered_json schema(Config config) {
    return schema_json([&](ConfigVisitor& visitor) { config.describe(visitor); });
}

/// Regular expressions of a decimal number, and of one with a unit that fits the key. The second is
/// empty if the key has no unit.
std::string number_pattern();
std::string quantity_pattern(const std::vector<std::string>& units);

} // namespace degs
