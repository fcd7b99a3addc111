// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "sim/simulation/run_result.hpp"

namespace degs::sim {

/// The section `foveation` of a report whose images are foveated.
nlohmann::ordered_json foveation_json(const RunResult& result);
/// A line with the pixels that are drawn and the errors of what each level shows.
std::string foveation_words(const RunResult& result);

} // namespace degs::sim
