// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/config_tree.hpp"

namespace degs {

/// Parses one YAML document without following its includes. Throws InputError.
ConfigNode parse_config_yaml(const std::string& name, const std::string& text);

} // namespace degs
