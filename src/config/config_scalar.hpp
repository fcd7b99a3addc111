// SPDX-License-Identifier: Apache-2.0
// Text of a configuration into values, strictly. Each function throws InputError with the sentence
// "<place>: key '<path>' is '<value>', but must be <what is allowed>."
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/config_tree.hpp"

namespace degs::config_scalar {

std::int64_t integer(const ConfigNode& node, const std::string& path, std::int64_t low,
                     std::int64_t high);
double real(const ConfigNode& node, const std::string& path, double low, double high);
bool boolean(const ConfigNode& node, const std::string& path);
const std::string& text(const ConfigNode& node, const std::string& path);
/// The index of the name.
int choice(const ConfigNode& node, const std::string& path, const std::vector<const char*>& names);

/// The error of a value that is not `allowed`; also used where a section is expected.
[[noreturn]] void reject(const ConfigNode& node, const std::string& path,
                         const std::string& allowed);

} // namespace degs::config_scalar
