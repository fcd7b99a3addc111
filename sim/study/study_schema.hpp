// SPDX-License-Identifier: Apache-2.0
// The JSON Schema of a study.
#pragma once

#include <vector>

#include "config/config_document.hpp"

namespace degs::sim {

/// Adds the keys of a study to `document`, which defines a design as "#/$defs/design" and an
/// include as "#/$defs/include". `keys` are those of all accelerators, which axes may vary; a key
/// that several have with different values stands there several times.
void add_study_schema(nlohmann::ordered_json& document, const std::vector<KeyDoc>& keys);

} // namespace degs::sim
