// SPDX-License-Identifier: Apache-2.0
// The keys that all accelerators have in common, and those of one: degs config --keys.
#pragma once

#include <string>
#include <vector>

#include "config/config_document.hpp"

namespace degs::sim {

/// Names of the parts into which the keys of a configuration are divided: all, shared, similar,
/// own, cost.
const std::vector<std::string>& key_parts();

/// Returns the keys of `document` that belong to `part`, in their order. A key is shared if every
/// accelerator has it with the same type, default, range and meaning. It is similar if several have
/// it with the same type, range and meaning, and the accelerator's own otherwise, except for its
/// areas and powers, which are the part cost. The values in `document` play no role.
std::vector<KeyDoc> keys_of_part(const std::vector<KeyDoc>& document, const std::string& part);

/// Returns a Markdown table of the similar keys with their default in each accelerator that has
/// them. Sections are left out.
std::string similar_keys_markdown();

/// Returns a Markdown table of the areas and powers of all accelerators, with a row for each block.
std::string cost_keys_markdown();

} // namespace degs::sim
