// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace degs::sim {

/// The files that have a schema: design, study, memory, technology and numbers.
std::vector<std::string> schema_names();
/// The JSON Schema of one of them, made from the descriptions that also read, print and document
/// the keys.
std::string schema_text(const std::string& name);

} // namespace degs::sim
