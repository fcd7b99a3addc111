// SPDX-License-Identifier: Apache-2.0
// What a search has spent, and what it believed of designs before it simulated them.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "sim/search/search_step.hpp"

namespace degs::sim {

/// The keys `search` and, for a search that believes something, `beliefs` of explore.json.
void put_record(const StudyPlan& plan, const Search& search, nlohmann::ordered_json& json);

/// beliefs.csv: a line for each simulated design, in the order of the rounds.
std::string beliefs_csv(const StudyPlan& plan, const Search& search);

/// Why there are no estimates, how many cycles were simulated, how far off beliefs were, and why
/// the search ended.
std::string record_text(const StudyPlan& plan, const Search& search);

} // namespace degs::sim
