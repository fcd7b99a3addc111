// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "sim/simulation/run_result.hpp"

namespace degs::sim {

/// The section `views` of a report whose frames have several.
nlohmann::ordered_json views_json(const RunResult& result);
/// A line that says what views share, and what each of them takes.
std::string views_words(const RunResult& result);

} // namespace degs::sim
