// SPDX-License-Identifier: Apache-2.0
// The keys that all accelerators have in common, and those of one: degs config --keys.
#pragma once

#include <string>
#include <vector>

#include "config/config_document.hpp"

namespace degs::sim {

/// Names of the parts into which the keys of a configuration are divided: all, shared, own.
const std::vector<std::string>& key_parts();

/// Returns the keys of `document` that belong to `part`, in their order. A key is shared if every
/// accelerator has it with the same type, default, range and meaning; every other key is the
/// accelerator's own. The values in `document` play no role.
std::vector<KeyDoc> keys_of_part(const std::vector<KeyDoc>& document, const std::string& part);

} // namespace degs::sim
