// SPDX-License-Identifier: Apache-2.0
// The estimates of --what-if for programs and for people.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "sim/simulation/what_if.hpp"

namespace degs::sim {

nlohmann::ordered_json what_if_json(const std::vector<WhatIf>& list);
/// A table for terminals; empty without a change.
std::string what_if_text(const std::vector<WhatIf>& list);

} // namespace degs::sim
